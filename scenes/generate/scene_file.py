"""Scene files in the layout of the hand-written ones: one line per object, short numbers."""

import json
import pathlib

SIGNIFICANT_DIGITS = 5


def rounded(value):
    """Numbers with few digits, whole ones without a point."""
    if isinstance(value, bool) or isinstance(value, str):
        return value
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [rounded(item) for item in value]
    number = float(f"{value:.{SIGNIFICANT_DIGITS}g}")
    return int(number) if number == int(number) else number


def write_scene(path, scene):
    """`scene` is the document without its version key; lists of named things get one line each."""
    lines = ['"lightbench": 1']
    for key, value in scene.items():
        value = rounded(value)
        if isinstance(value, list):
            items = ",\n".join(" " + json.dumps(item) for item in value)
            lines.append(f'"{key}": [\n{items}\n]')
        else:
            lines.append(f'"{key}": {json.dumps(value)}')
    path = pathlib.Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8", newline="\n")


def rotation(axis, degrees):
    return {"axis": axis, "degrees": degrees}
