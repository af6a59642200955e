"""The shelter at rest, when its rows fire, and what every peer prints: shared by the Python peers."""

import argparse
import json
import math
import statistics
from dataclasses import dataclass

TIRE_MASS = 280.0
LAUNCH = 6.0
FRICTION = 0.5
GRAVITY = 9.81


@dataclass
class Scene:
    tires: list  # (x, y) at rest
    cables: list  # (tire, tire, length, stiffness)
    shots: list  # (time, launched tires), in order of time


@dataclass
class Outcome:
    """One run: its peaks, and the time of its stepping loop."""

    height: float
    height_at: float
    force: float
    force_at: float
    wall: float


def options_parser(peer):
    parser = argparse.ArgumentParser(description=f"The shelter in {peer}: one line of JSON on stdout.")
    parser.add_argument("--layout", choices=["grid", "quincunx"], default="grid")
    parser.add_argument("--rows", type=int, default=20)
    parser.add_argument("--columns", type=int, default=20)
    parser.add_argument("--spacing", type=float, default=1.5, help="m")
    parser.add_argument("--blast-rows", type=blast_rows, default="6-15", help="6-15, 2,3,4 or 1.5")
    parser.add_argument("--slope-percent", type=float, default=0, help="fall of the ground, toward -y")
    parser.add_argument("--tilt", type=float, default=0, help="of launches toward +x, degrees")
    parser.add_argument("--delay", type=float, default=0.02, help="between rows, s")
    parser.add_argument("--axial-stiffness", type=float, default=1.4e6, help="EA, N")
    parser.add_argument("--duration", type=float, default=1.0, help="s")
    parser.add_argument("--step", type=float, default=1e-3, help="s")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--reference-height", type=float, default=1.82570, help="m")
    parser.add_argument("--reference-force", type=float, default=26750.4, help="N")
    return parser


def blast_rows(text):
    first, dash, last = text.partition("-")
    if dash:
        return [float(row) for row in range(int(first), int(last) + 1)]
    return [float(row) for row in text.split(",")]


def step_count(options):
    return round(options.duration / options.step)


def build_scene(options):
    rows, columns = range(1, options.rows + 1), range(1, options.columns + 1)
    places = [(row, column) for row in rows for column in columns]
    cells = [(row, column) for row in rows[:-1] for column in columns[:-1]]
    links = [((row, column), (row, column + 1)) for row in rows for column in columns[:-1]]
    links += [((row, column), (row + 1, column)) for row in rows[:-1] for column in columns]
    if options.layout == "grid":
        for row, column in cells:
            links += [((row, column), (row + 1, column + 1)), ((row, column + 1), (row + 1, column))]
    else:
        for row, column in cells:
            centre = (row + 0.5, column + 0.5)
            places.append(centre)
            corners = [(row, column), (row, column + 1), (row + 1, column), (row + 1, column + 1)]
            links += [(centre, corner) for corner in corners]

    numbers = {place: number for number, place in enumerate(places)}
    cables = []
    for start, end in links:
        length = options.spacing * math.dist(start, end)
        cables.append((numbers[start], numbers[end], length, options.axial_stiffness / length))
    shots = [
        (shot * options.delay, [numbers[place] for place in places if place[0] == row])
        for shot, row in enumerate(options.blast_rows)
    ]
    tires = [(column * options.spacing, row * options.spacing) for row, column in places]
    return Scene(tires, cables, shots)


def launches_by_step(scene, step):
    """Step number -> tires launched at its start."""
    launches = {}
    for time, launched in scene.shots:
        launches.setdefault(round(time / step), []).extend(launched)
    return launches


def print_json(peer, version, precision, options, outcomes):
    walls = [outcome.wall for outcome in outcomes]
    first = outcomes[0]
    print(json.dumps({
        "peer": peer,
        "version": version,
        "precision": precision,
        "dt_s": options.step,
        "steps": step_count(options),
        "wall_s": {"min": min(walls), "median": statistics.median(walls)},
        "height_m": first.height,
        "height_at_s": first.height_at,
        "force_n": first.force,
        "force_at_s": first.force_at,
        "height_error": abs(first.height / options.reference_height - 1),
        "force_error": abs(first.force / options.reference_force - 1),
    }))
