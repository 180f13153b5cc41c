# SPDX-License-Identifier: BSD-3-Clause
"""The benchmark's report: tables as CSV and as Markdown, and plots; who is on the Pareto front, and which peers are not beaten.

`measured` is a list of pairs, of a Case and what measure_case() has of it.
"""

import csv
import io
import os
import re

from . import charts
from .bench_scenes import ISOSURFACES, RADIUS, SPREADS, shared_meshes
from .bench_stage import (
    BACKENDS,
    EWA,
    FILL,
    FLYING_EDGES,
    FRAMES,
    GAUSSIAN,
    MESH,
    MOST_SECONDS,
    OPEN3D,
    OUR_WAYS,
    OURS,
    PEERS,
    POINT_SIZE,
    POINTS,
    TIMES,
    TWICE,
)
from .writers import write_whole

MEASURES = {  # name: heading, format, factor
    "psnr": ("PSNR, dB", "{:.2f}", 1),
    "ssim": ("SSIM", "{:.4f}", 1),
    "normal_mean": ("normals, degrees", "{:.2f}", 1),
    "normal_95": ("95%", "{:.2f}", 1),
    "depth": ("depth, % of diagonal", "{:.4f}", 100),
    "iou": ("IoU", "{:.4f}", 1),
    "unfilled": ("unfilled, %", "{:.3f}", 100),
}
COLUMNS = {  # of the tables of scenes
    "milliseconds": ("ms", "{:.1f}", 1),
    "processor_milliseconds": ("ms, threads", "{:.1f}", 1),
    "frames": ("frames", "{:.0f}", 1),
    "first_milliseconds": ("first frame, ms", "{:.0f}", 1),
    **MEASURES,
}
JUDGED = ("milliseconds", "first_milliseconds", "psnr", "normal_mean")  # of what is picked, and of what is best
CLOSE = 0.5  # dB that what is called best may be behind the least error, if it is faster
CLEAR_TIME, CLEAR_ERROR = 0.9, 0.3  # share of the time at most, and dB less at least, that are no chance of a run
FEW, MANY = 1_000_000, 20_000_000  # points that are to cost nearly the same
MOST_RATIO, MOST_LOSS = 2, 0.5  # of their times, and dB
FAMILY = "points of OpenGL"


# ----------------------------------------------------------------------------------------------------------------------
def pareto(rows):
    """The names of the renderers that no other one beats in both milliseconds and PSNR; truth and yardstick are apart."""
    names = [name for name in rows if name not in (MESH, FLYING_EDGES, EWA)]
    return [name for name in names if not any(_beats(rows[other], rows[name]) for other in names)]


def _beats(one, other):
    pair = (one["milliseconds"], -one["psnr"]), (other["milliseconds"], -other["psnr"])
    return pair[0] != pair[1] and all(x <= y for x, y in zip(*pair))


def exceptions(rows):
    """The peers that none of ours is as fast as at no larger error, and the fastest of ours at no larger error, or None."""
    result = {}
    for peer in (name for name in PEERS if name in rows):
        as_good = [name for name in OUR_WAYS if name in rows and rows[name]["psnr"] >= rows[peer]["psnr"]]
        fastest = min(as_good, key=lambda name: rows[name]["milliseconds"], default=None)
        if fastest is None or rows[fastest]["milliseconds"] > rows[peer]["milliseconds"]:
            result[peer] = fastest
    return result


def by_backend(result, backend):
    """The rows of our methods, with no supersampling, by a back end."""
    suffix = "" if backend == result["automatic"] else f", {backend}"
    return {name: result["rows"][name + suffix] for name in OURS if name + suffix in result["rows"]}


def beaters(rows, name):
    """Those that beat what is of that name in both milliseconds and PSNR, the least error first; none: it is on the front."""
    return sorted((other for other in rows if _beats(rows[other], rows[name])), key=lambda other: -rows[other]["psnr"])


def best(rows):
    """The fastest of those that are CLOSE to the least error."""
    most = max(row["psnr"] for row in rows.values())
    return min((name for name in rows if rows[name]["psnr"] >= most - CLOSE), key=lambda name: rows[name]["milliseconds"])


# ----------------------------------------------------------------------------------------------------------------------
def write_report(folder, measured, wanted, command):
    """wanted: the number of measurements that there are to be."""
    write_whole(os.path.join(folder, "results.csv"), _csv(measured).encode())
    for case, result in measured:
        name = re.sub(r"[^\w.-]", "-", case.title.replace(",", ""))
        _write_pareto_plot(os.path.join(folder, f"{name}.png"), case, result["rows"])
    shown, result = _shown(measured)
    _write_pareto_plot(os.path.join(folder, "RESULTS.png"), shown, result["rows"])
    plots = [f"![PSNR against milliseconds: {shown.title}](RESULTS.png)"]
    for what, key, measure in (
        ("points", lambda case: case.points, "milliseconds"),
        ("pixels", lambda case: case.pixels**2, "milliseconds"),
        ("density", lambda case: case.points / case.pixels**2, "psnr"),
    ):
        if title := _write_series(folder, measured, what, key, measure):
            plots.append(f"![{COLUMNS[measure][0]} over {what}: {title}](RESULTS-{what}.png)")
    write_whole(os.path.join(folder, "RESULTS.md"), _markdown(measured, wanted, command, plots).encode())


def _shown(measured):
    """The case, and its results, that stands for all where one is to be shown: the first one of a million points."""
    return next((each for each in measured if each[0].points >= 1_000_000), measured[0])


def _write_pareto_plot(path, case, rows):
    """Error against milliseconds; a line joins a method with what it is at twice the resolution, and points of all sizes."""
    series = {}
    for name, row in rows.items():
        if name != EWA:
            family = FAMILY if name in POINTS else name.removesuffix(f" {TWICE}")
            series.setdefault(family, []).append((row["milliseconds"], row["psnr"]))
    sizes = ", ".join(str(size) for name, size in POINTS.items() if name in rows)
    also = {FAMILY: f"{FAMILY}, {sizes} px"}
    series = {also.get(name, name if len(points) == 1 else f"{name}, also {TWICE}"): points for name, points in series.items()}
    front = sorted((rows[name]["milliseconds"], rows[name]["psnr"]) for name in pareto(rows))
    charts.write_scatter(path, case.title, "milliseconds a frame", "PSNR, dB", series, front)


def _write_series(folder, measured, what, key, measure):
    """A plot over what varies, of the scene and the rest that most cases have in common; returns its title."""
    groups = {}
    for case, result in measured:
        if case.scene not in (*SPREADS, *ISOSURFACES):
            rest = f"{case.points} points" if what == "pixels" else f"{case.pixels} x {case.pixels}"
            groups.setdefault(f"{os.path.basename(case.scene)}, {rest}", {})[key(case)] = result["rows"]
    title, group = max(groups.items(), key=lambda item: len(item[1]), default=("", {}))
    if len(group) < 2:
        return ""
    heading = {"milliseconds": "milliseconds a frame", "psnr": "PSNR, dB"}[measure]
    label = "points a pixel" if what == "density" else what
    drawn = [name for name in (*OURS, *PEERS, MESH) if all(name in rows for rows in group.values())]
    series = {name: sorted((x, rows[name][measure]) for x, rows in group.items()) for name in drawn}
    path = os.path.join(folder, f"RESULTS-{what}.png")
    charts.write_scatter(path, title, label, heading, series, logarithmic=measure == "milliseconds")
    return title


def _csv(measured):
    text = io.StringIO()
    columns = [*TIMES, *MEASURES]
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["scene", "points", "pixels", "drawn by", *columns])
    for case, result in measured:
        for name, row in result["rows"].items():
            writer.writerow([case.scene, case.points, case.pixels, name, *(row[column] for column in columns)])
    return text.getvalue()


# ----------------------------------------------------------------------------------------------------------------------
def _markdown(measured, wanted, command, plots):
    sections = [
        _introduction(measured, wanted, command),
        [each for plot in plots for each in (plot, "")][:-1],
        _front_section(measured),
        _exceptions_section(measured),
        _picked_section(measured),
        _many_points_section(measured),
        _scenes_section(measured),
    ]
    return "\n\n".join("\n".join(lines) for lines in sections if lines) + "\n"


def _introduction(measured, wanted, command):
    drawn = {name for _, result in measured for name in result["rows"]}
    minutes = sum(result["seconds"] for _, result in measured) / 60
    automatic = measured[0][1]["automatic"]
    other = next(backend for backend in BACKENDS if backend != automatic)
    text = INTRODUCTION.format(
        command=command, renderer=measured[0][1]["renderer"], minutes=minutes, other=other, automatic=automatic
    )
    lines = text.splitlines()
    if EWA in drawn:
        lines += [f"- {EWA}: the two-pass splatter of Testing/Reference, which is the yardstick of errors, not of time."]
    if OPEN3D in drawn:
        lines += [f"- {OPEN3D}'s offscreen renderer draws points of {POINT_SIZE} pixels, each frame with its reading back."]
    if set(shared_meshes()) & {case.scene for case, _ in measured}:
        lines += [CREDIT]
    if len(measured) < wanted:
        lines += ["", f"{len(measured)} of {wanted} measurements are made; the same command goes on."]
    return lines


def _front_section(measured):
    lines = ["## The fronts", "", "What none but the mesh beats in both time and PSNR, the fastest first: ms, dB.", ""]
    lines += _table(["scene", "front", "mesh"], "lll")
    for case, result in measured:
        if case.scene in SPREADS:  # with no peers
            continue
        rows = result["rows"]
        front = sorted(pareto(rows), key=lambda name: rows[name]["milliseconds"])
        mesh = next((_figures(rows[name]) for name in (MESH, FLYING_EDGES) if name in rows), "")
        cells = [_link(case), "; ".join(f"{name}: {_figures(rows[name])}" for name in front), mesh]
        lines.append(_row(cells))
    return lines


def _figures(row):
    return f"{row['milliseconds']:.1f}, {row['psnr']:.1f}"


def _exceptions_section(measured):
    lines = ["## Exceptions", "", "Peers that none of ours is as fast as at no larger error"]
    found = [(case, result["rows"], exceptions(result["rows"])) for case, result in measured]
    if not any(each for _, _, each in found):
        return [*lines[:2], f"{lines[2]}: none."]
    lines[2] += ", and the fastest of ours at no larger error:"
    lines += ["", *_table(["scene", "peer", "ms", "PSNR, dB", "ours", "ms", "PSNR, dB"], "llrrlrr")]
    for case, rows, peers in found:
        for peer, ours in peers.items():
            cells = [_link(case), peer, *_figures(rows[peer]).split(", ")]
            lines.append(_row([*cells, ours or "none", *(_figures(rows[ours]).split(", ") if ours else ["", ""])]))
    return lines


def _picked_section(measured):
    """What vtkPointSurfaceMapperFactory picks beside what measures best, and what beats it."""
    picks = [
        (case, backend, rows, result["picked"][backend])
        for case, result in measured
        for backend in BACKENDS
        if len(rows := by_backend(result, backend)) > 1 and result["picked"][backend] in rows
    ]
    if not picks:
        return []
    others = [best(rows) if best(rows) != picked else "" for _, _, rows, picked in picks]
    beaten = [(*pick, names[0]) for pick in picks if (names := beaters(pick[2], pick[3]))]
    clear = sum(_is_clear(*row[2:]) for row in beaten)
    lines = [*PICKED.splitlines(), "", f"Picked is what measures best in {others.count('')} of {len(picks)}. It is on the front, where"]
    lines += [f"none of ours beats it in both time and PSNR, in {len(picks) - len(beaten)}, and clearly beaten in {clear}."]
    if beaten:
        rows = (_picked_row(*row, "yes" if _is_clear(*row[2:]) else "no") for row in beaten)
        lines += ["", "What is not on the front:", "", *_picked_head("beaten by", "clearly"), *rows]
    lines += ["", "All that is picked, beside what is best where that is another one:"]
    return [*lines, "", *_picked_head("best"), *(_picked_row(*pick, other) for pick, other in zip(picks, others))]


def _picked_head(other, *more):
    figures = [COLUMNS[column][0] for column in JUDGED]
    sides = "r" * len(JUDGED)
    return _table(["scene", "back end", "picked", *figures, other, *figures, *more], f"lll{sides}l{sides}{'l' * len(more)}")


def _picked_row(case, backend, rows, picked, other, *more):
    judged = _judged(rows[other]) if other else [""] * len(JUDGED)
    return _row([_link(case), backend, picked, *_judged(rows[picked]), other, *judged, *more])


def _is_clear(rows, picked, other):
    ratio = rows[other]["milliseconds"] / rows[picked]["milliseconds"]
    return ratio <= CLEAR_TIME and rows[other]["psnr"] >= rows[picked]["psnr"] + CLEAR_ERROR


def _judged(row):
    return [_cell(row, column) for column in JUDGED]


def _many_points_section(measured):
    """What many points cost beside few, of the same surface in the same viewport."""
    results = {(case.scene, case.points, case.pixels): result for case, result in measured}
    lines = []
    for (scene, points, pixels), few in results.items():
        many = results.get((scene, MANY, pixels))
        if points != FEW or not many:
            continue
        for name in dict.fromkeys([few["picked"][few["automatic"]], "pull-push"]):
            a, b = few["rows"][name], many["rows"][name]
            ratio = b["processor_milliseconds"] / a["processor_milliseconds"]
            loss = a["psnr"] - b["psnr"]
            label = f"{name}, picked" if name == few["picked"][few["automatic"]] else name
            cells = [f"{scene}, {pixels} x {pixels}", label]
            cells += [f"{row['processor_milliseconds']:.1f}" for row in (a, b)] + [f"{ratio:.2f}"]
            cells += [f"{row['psnr']:.2f}" for row in (a, b)] + [f"{-loss:+.2f}"]
            lines.append(_row([*cells, "yes" if ratio <= MOST_RATIO and loss <= MOST_LOSS else "no"]))
    if not lines:
        return []
    few, many = (f"{count // 1_000_000} million" for count in (FEW, MANY))
    head = ["scene", "drawn by", f"ms, threads, {few}", many, "ratio", f"PSNR, dB, {few}", many, "difference", "met"]
    return [*MANY_POINTS.splitlines(), "", *_table(head, "llrrrrrrl"), *lines]


def _scenes_section(measured):
    lines = ["## Scenes"]
    for case, result in measured:
        rows = result["rows"]
        front = pareto(rows)
        lines += ["", f"### {case.title[0].upper()}{case.title[1:]}", ""]
        if case.scene in ISOSURFACES:
            lines += [*ISOSURFACE.splitlines(), ""]
        lines += _table(["drawn by", *(heading for heading, _, _ in COLUMNS.values())], "l" + "r" * len(COLUMNS))
        for name, row in rows.items():
            lines.append(_row([f"{name}{' *' if name in front else ''}", *(_cell(row, column) for column in COLUMNS)]))
    return lines


def _cell(row, column):
    _, layout, factor = COLUMNS[column]
    return "" if row[column] is None else layout.format(factor * row[column])


def _link(case):
    return f"[{case.title}](#{re.sub(r'[^a-z0-9 -]', '', case.title.lower()).replace(' ', '-')})"


def _table(head, sides):
    """The head of a table; sides: a letter l or r for each column."""
    return [_row(head), _row(["---" if side == "l" else "---:" for side in sides])]


def _row(cells):
    return "| " + " | ".join(cells) + " |"


INTRODUCTION = f"""# Speed against error

By `{{command}}`, on {{renderer}}, in {{minutes:.0f}} minutes.

- ms: the median of {FRAMES} frames after warm-up, camera moving, until OpenGL has finished them, by the clock; of fewer
  where {MOST_SECONDS} seconds hold no more, as the column "frames" says. ms, threads: of the process, over all its threads.
- First frame: with all that is done once, such as upload, order in space, and the fit of algebraic splats.
- Points are sampled uniformly by area, at random, with exact normals and a radius of {RADIUS} times the mean spacing.
- {GAUSSIAN} draws opaque discs of 0.7 of the radius, triangle scale 1; {FILL} fills between points
  of 1 pixel; these, and {FAMILY}, draw colours of points that were lit one by one.
- {{other}} after a name: by that back end; otherwise it is {{automatic}}, which is taken by itself here. {TWICE}: supersampling.
- Truth: the mesh, 16 samples a pixel. 95%: of the angles between normals, the 95th percentile.
- A star: none but the mesh beats it in both time and PSNR.
"""
CREDIT = "- The models bunny, armadillo, dragon, buddha and lucy are of the Stanford University Computer Graphics Laboratory."
PICKED = f"""## What is picked

The mapper that vtkPointSurfaceMapperFactory picks, by back end, and, where it is another one, what measures best: the
fastest of ours within {CLOSE} dB of the least error that one of them has, with no supersampling. Clearly beaten is what
another one is ahead of by {100 - 100 * CLEAR_TIME:.0f}% of the time and {CLEAR_ERROR} dB, of those that beat it the one of the least error. For points
without normals the time to the first frame counts too, in which the others estimate them, and the normals where there
is noise (in mean spacings, along the normal; direct.md has more of it)."""
MANY_POINTS = f"""## As many points as there may be

{MANY // 1_000_000} million points beside {FEW // 1_000_000} million on the same surface; aimed at: at most {MOST_RATIO} times the time of all threads, and at
most {MOST_LOSS} dB less."""
ISOSURFACE = """From a new isovalue to the finished frame: of ours with vtkIsosurfacePoints, of the mesh with vtkFlyingEdges3D,
its normals among it. The isovalue is another one in every frame."""
