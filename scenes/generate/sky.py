"""Draws textures/sky.hdr: an evening sky for the environment image, 256 x 128, Radiance HDR.

Equirectangular, top row up. No real place: a smooth gradient, a soft low sun and its glow, brown ground.
The sun is wide (16 degrees across) and not very bright, so that even a renderer that does not sample the
picture by brightness converges.
"""

import math
import pathlib

WIDTH, HEIGHT = 256, 128
SUN_AZIMUTH, SUN_ELEVATION = 130, 24   # degrees
SUN_RADIANCE = (20.0, 14.5, 9.0)
ZENITH, HORIZON, GROUND = (0.12, 0.25, 0.62), (0.95, 0.72, 0.50), (0.16, 0.13, 0.10)


def mix(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def smooth(x, low, high):
    t = min(max((x - low) / (high - low), 0.0), 1.0)
    return t * t * (3 - 2 * t)


def direction(azimuth, elevation):
    a, e = math.radians(azimuth), math.radians(elevation)
    return (math.cos(e) * math.cos(a), math.sin(e), math.cos(e) * math.sin(a))


def radiance(azimuth, elevation):
    sky = mix(HORIZON, ZENITH, smooth(elevation, -8, 65) ** 0.7)
    cosine = sum(a * b for a, b in zip(direction(azimuth, elevation),
                                       direction(SUN_AZIMUTH, SUN_ELEVATION)))
    away = math.degrees(math.acos(min(1.0, cosine)))
    sky = tuple(s + 0.08 * c * math.exp(-away / 14) + c * (1 - smooth(away, 5.0, 11.0))
                for s, c in zip(sky, SUN_RADIANCE))
    return mix(GROUND, sky, smooth(elevation, -2.5, 0.5))


def rgbe(color):
    """Radiance's shared-exponent pixel."""
    fraction, exponent = math.frexp(max(color))
    scale = fraction * 256 / max(color)
    return bytes(int(c * scale) for c in color) + bytes([exponent + 128])


def packed(plane):
    """Run-length code of one component of a row: runs of 4 and more, else literals."""
    out, i, literal = bytearray(), 0, bytearray()
    while i <= len(plane):
        run = 0
        while i + run < len(plane) and run < 127 and plane[i + run] == plane[i]:
            run += 1
        if literal and (run >= 4 or len(literal) == 128 or i == len(plane)):
            out += bytes([len(literal)]) + literal
            literal = bytearray()
        if i == len(plane):
            break
        if run >= 4:
            out += bytes([128 + run, plane[i]])
            i += run
        else:
            literal.append(plane[i])
            i += 1
    return bytes(out)


def write(folder):
    data = bytearray(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (HEIGHT, WIDTH))
    for y in range(HEIGHT):
        elevation = 90 - 180 * (y + 0.5) / HEIGHT
        row = [rgbe(radiance(360 * (x + 0.5) / WIDTH - 180, elevation)) for x in range(WIDTH)]
        data += bytes([2, 2, WIDTH >> 8, WIDTH & 255])
        for component in range(4):
            data += packed(bytes(pixel[component] for pixel in row))
    path = pathlib.Path(folder) / "textures" / "sky.hdr"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)
