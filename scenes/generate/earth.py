#!/usr/bin/env python3
"""Draws scenes/textures/earth.png from Natural Earth land outlines.

    npm pack world-atlas && tar xf world-atlas-*.tgz
    python3 earth.py package/countries-50m.json ../textures/earth.png

Needs numpy and Pillow. The map is equirectangular: longitude -180 at the left edge, +180 at the right,
latitude +90 in the top row. Outlines are Natural Earth's (public domain); the colours are painted here:
a tint by latitude, soft ellipses for the great deserts and rain forests, ice, and shallow water that
fades away from the coasts.
"""

import json
import sys

import numpy as np
from PIL import Image, ImageDraw, ImageFilter

WIDTH, HEIGHT = 2048, 1024
OVERSAMPLING = 2
COLOURS = 256

# sRGB bytes.
DEEP, SHALLOW = (24, 62, 112), (64, 126, 166)
GRASS, TAIGA, TUNDRA = (104, 128, 66), (66, 96, 62), (140, 138, 116)
DESERT, FOREST = (204, 176, 124), (44, 92, 46)
ICE = (238, 243, 247)
ICE_COUNTRIES = ("Antarctica", "Greenland")

# Longitude, latitude, half widths in degrees, strength.
DESERTS = [
    (8, 23, 30, 10, 1.0), (26, 24, 12, 9, 1.0), (46, 24, 13, 11, 1.0), (60, 32, 12, 7, 0.8),
    (64, 42, 12, 6, 0.7), (84, 40, 14, 6, 0.9), (104, 42, 14, 6, 0.8), (71, 27, 6, 5, 0.8),
    (131, -25, 16, 9, 0.9), (21, -23, 8, 7, 0.8), (-70, -24, 4, 9, 0.9), (-68, -44, 5, 9, 0.6),
    (-112, 34, 11, 9, 0.7), (-104, 27, 6, 6, 0.6), (44, 8, 8, 6, 0.6),
]
FORESTS = [
    (-63, -4, 14, 10, 1.0), (22, 0, 12, 6, 1.0), (112, 0, 22, 9, 1.0), (142, -5, 10, 5, 0.9),
    (-86, 14, 8, 5, 0.6), (98, 18, 9, 8, 0.6), (-79, 36, 9, 8, 0.4), (11, 49, 12, 6, 0.3),
    (48, -19, 3, 7, 0.4),
]


def decode_arcs(topology):
    """Quantised, delta-encoded arcs to lists of (longitude, latitude)."""
    scale_x, scale_y = topology["transform"]["scale"]
    origin_x, origin_y = topology["transform"]["translate"]
    arcs = []
    for arc in topology["arcs"]:
        x = y = 0
        points = []
        for dx, dy in arc:
            x += dx
            y += dy
            points.append((x * scale_x + origin_x, y * scale_y + origin_y))
        arcs.append(points)
    return arcs


def ring_points(ring, arcs):
    """Arc ~i is arc i walked backwards; consecutive arcs share their joint."""
    points = []
    for index in ring:
        arc = arcs[index] if index >= 0 else arcs[~index][::-1]
        points.extend(arc[1:] if points else arc)
    return points


def draw_ring(image, points, hole):
    """A ring that crosses the antimeridian is drawn in every copy of the map it touches. One that runs
    around a pole (Antarctica's coast, stored as a hole) is closed through that pole and is land."""
    lons, lats = np.asarray(points).T
    lons = np.unwrap(lons, period=360)
    if abs(lons[-1] - lons[0]) > 180:
        pole = 90 if lats.mean() > 0 else -90
        lons = np.concatenate([lons, [lons[-1], lons[0]]])
        lats = np.concatenate([lats, [pole, pole]])
        hole = False
    y = (90 - lats) / 180 * image.height
    for shift in (-360, 0, 360):
        x = (lons + shift + 180) / 360 * image.width
        ImageDraw.Draw(image).polygon(list(zip(x, y)), fill=0 if hole else 255)


def land_masks(topology):
    """Coverage of land and of ice-bound land in [0,1]."""
    arcs = decode_arcs(topology)
    size = (WIDTH * OVERSAMPLING, HEIGHT * OVERSAMPLING)
    land, ice = Image.new("L", size, 0), Image.new("L", size, 0)
    for country in topology["objects"]["countries"]["geometries"]:
        polygons = country["arcs"] if country["type"] == "MultiPolygon" else [country["arcs"]]
        icy = country["properties"]["name"] in ICE_COUNTRIES
        for polygon in polygons:
            for hole, ring in enumerate(polygon):
                points = ring_points(ring, arcs)
                for mask in (land, ice) if icy else (land,):
                    draw_ring(mask, points, hole > 0)
    shrink = lambda image: np.asarray(image.resize((WIDTH, HEIGHT), Image.Resampling.BOX)) / 255.0
    return shrink(land), shrink(ice)


def blobs(longitude, latitude, ellipses):
    """Union of soft ellipses, in [0,1]."""
    bare = np.ones_like(longitude)
    for lon, lat, half_lon, half_lat, strength in ellipses:
        r2 = ((longitude - lon) / half_lon) ** 2 + ((latitude - lat) / half_lat) ** 2
        bare *= 1 - strength * np.exp(-(r2**1.5))
    return 1 - bare


def clouds(random):
    """Smooth random field of about unit size, periodic in longitude."""
    field = np.zeros((HEIGHT, WIDTH))
    for cells, weight in ((12, 0.6), (24, 0.4), (48, 0.25), (96, 0.15), (192, 0.1)):
        grid = random.uniform(-1, 1, (cells // 2, cells)).astype(np.float32)
        grid = np.concatenate([grid[:, -2:], grid, grid[:, :2]], axis=1)
        column = WIDTH // cells
        image = Image.fromarray(grid).resize((WIDTH + 4 * column, HEIGHT), Image.Resampling.BICUBIC)
        margin = (image.width - WIDTH) // 2
        field += weight * np.asarray(image)[:, margin:margin + WIDTH]
    return field


def ramp(x, low, high):
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


def mix(a, b, t):
    """a where t is 0, b where t is 1; t has one value per pixel."""
    return a + (np.asarray(b, dtype=float) - a) * t[..., None]


def paint(land, ice):
    latitude = np.repeat((90 - (np.arange(HEIGHT) + 0.5) / HEIGHT * 180)[:, None], WIDTH, axis=1)
    longitude = np.repeat(((np.arange(WIDTH) + 0.5) / WIDTH * 360 - 180)[None, :], HEIGHT, axis=0)
    random = np.random.default_rng(1)
    shade = clouds(random)
    longitude += 6 * clouds(random)
    ragged = latitude + 4 * clouds(random)
    polar = np.abs(ragged)

    ground = np.broadcast_to(np.asarray(GRASS, dtype=float), (HEIGHT, WIDTH, 3))
    ground = mix(ground, TAIGA, ramp(polar, 42, 56))
    ground = mix(ground, TUNDRA, ramp(polar, 60, 70))
    ground = mix(ground, DESERT, blobs(longitude, ragged, DESERTS))
    ground = mix(ground, FOREST, blobs(longitude, ragged, FORESTS))
    ground = ground * (1 + 0.08 * shade[..., None])
    ground = mix(ground, ICE, np.maximum(ramp(polar, 74, 80), ice))

    coast = Image.fromarray((land * 255).astype(np.uint8)).filter(ImageFilter.GaussianBlur(14))
    water = np.broadcast_to(np.asarray(DEEP, dtype=float), (HEIGHT, WIDTH, 3))
    water = mix(water, SHALLOW, np.clip(np.asarray(coast) / 255.0 * 1.6, 0, 1))
    water = mix(water, ICE, ramp(ragged, 80, 84))  # the floating ice of the Arctic
    return mix(water, ground, land)


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: earth.py COUNTRIES_TOPOJSON OUT_PNG")
    with open(sys.argv[1], encoding="utf-8") as file:
        topology = json.load(file)
    picture = Image.fromarray(np.rint(np.clip(paint(*land_masks(topology)), 0, 255)).astype(np.uint8))
    picture = picture.quantize(COLOURS, method=Image.Quantize.MEDIANCUT, kmeans=1,
                               dither=Image.Dither.NONE)
    picture.save(sys.argv[2], optimize=True)


if __name__ == "__main__":
    main()
