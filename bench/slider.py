#!/usr/bin/env python3
"""Measures what the studio takes while a number of the objects of Foundry (2016) changes: from the new text to the coarse
picture of a layer, from there to its picture as fine as the screen, and to a tile of 1024 x 1024 voxels as the printer gets
them; all in processor time of the server, the least of five edits.

    python3 bench/slider.py build/release/apps/ombre/ombre
"""
import argparse
import math
import os
import pathlib
import shutil

import programs
import studio

# The number that changes, and the layer that is looked at, as a share of the height.
OBJECTS = {"paddle": ("pimple", 0.5), "ski": ("full", 0.3), "tweel": ("holes", 0.5), "bone": ("compact", 0.5),
           "helmet": ("cell", 0.5)}
SCREEN = 1000     # pixels along the longer side of a layer that fits the view
COARSER = 3       # levels by which the first picture of a layer is coarser, as on the page
EDITS = 5
COLUMNS = ("object", "number", "level", "load s", "coarse s", "screen s", "voxels s")


def processor_seconds(process):
    user, system = pathlib.Path(f"/proc/{process.pid}/stat").read_text(encoding="ascii").rsplit(")", 1)[1].split()[11:13]
    return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")


def layer(connection, design, share, level):
    """Asks for a whole layer in tiles, as the page does."""
    plan, _ = connection.ask("plan", design=design, level=level, **studio.PRINTER)
    columns, rows, layers = plan["count"]
    for x in range(0, columns, 1024):
        for y in range(0, rows, 1024):
            connection.ask("tile", design=design, level=level, layer=int(layers * share), x=x, y=y,
                           width=min(1024, columns - x), height=min(1024, rows - y), **studio.PRINTER)


def level_that_fits(connection, design):
    plan, _ = connection.ask("plan", design=design, **studio.PRINTER)
    return max(0, math.ceil(math.log2(max(plan["count"][:2]) / SCREEN)))


def tile_of_voxels(connection, design, share):
    plan, _ = connection.ask("plan", design=design, **studio.PRINTER)
    connection.ask("tile", design=design, layer=int(plan["count"][2] * share), **studio.window(plan["count"]), **studio.PRINTER)


def edit(process, connection, example, share, level):
    """Processor time after an edit: of loading, until the coarse picture, and from there to the finer ones."""
    times = [processor_seconds(process)]
    def note():
        times.append(processor_seconds(process))
    design = studio.load(connection, example)
    note()
    layer(connection, design, share, level + COARSER)
    note()
    layer(connection, design, share, level)
    note()
    tile_of_voxels(connection, design, share)
    note()
    began, loaded, coarse, screen, voxels = times
    return loaded - began, coarse - began, screen - coarse, voxels - screen


def measure(process, connection, folder, name):
    variable, share = OBJECTS[name]
    text = (programs.ROOT / "examples" / f"{name}.vcad").read_text(encoding="utf-8")
    example = studio.Example(name, variable, text)
    (folder / example.file).write_text(text, encoding="utf-8")
    level = level_that_fits(connection, studio.load(connection, example))
    runs = [edit(process, connection, example, share, level) for _ in range(EDITS)]
    return name, variable, level, *(f"{min(times):.2f}" for times in zip(*runs))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ombre", type=pathlib.Path)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"{', '.join(OBJECTS)} (default: all)")
    args = parser.parse_args()
    programs.stop_on_signals()
    print(*COLUMNS, sep="\t", flush=True)
    with programs.scratch_folder() as folder, studio.studio(args.ombre.resolve(), folder) as (process, connection):
        shutil.copytree(programs.ROOT / "examples" / "models", folder / "models")
        for name in args.names or OBJECTS:
            print(*measure(process, connection, folder, name), sep="\t", flush=True)


if __name__ == "__main__":
    main()
