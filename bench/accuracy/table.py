# SPDX-License-Identifier: MIT
"""Compares the fronts of error against CPU time: a table on stdout, and a chart by gnuplot.

    table.py OUT_DIR CASE ...

OUT_DIR holds what accuracy.sh wrote. Each engine is judged by its front, the least CPU time at which
any of its settings keeps within an error, linear between points in both logarithms.
"""
import csv
import glob
import math
import sys

ROUNDING = 1e-12  # errors below count as this
USELESS = 0.1  # of a length in m, of an angle in rad, of a ratio: nobody would want a larger error
SAMPLES = 50
COLOURS = ["#cc3311", "#0077bb", "#33bbee", "#882255", "#cc6677", "#117733", "#88bb55", "#aa4499", "#ddaa33", "#777777",
           "#332288", "#44aa99", "#999933"]


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def front(points):
    """Points (error, cost) that no other beats in both, from the cheapest on."""
    best = []
    for cost, error in sorted((cost, max(error, ROUNDING)) for error, cost in points):
        if not best or error < best[-1][0]:
            best.append((error, cost))
    return best


def cost_at(line, error):
    """Least cost of an error that the front reaches."""
    for (e0, c0), (e1, c1) in zip(line, line[1:]):
        if e1 <= error <= e0:
            share = math.log(e0 / error) / math.log(e0 / e1)
            return c0 * (c1 / c0) ** share
    return line[0][1] if error >= line[0][0] else line[-1][1]


def ratio(peer, plumb):
    """Geometric mean of peer's cost over Plumb's, over the errors of use that both keep within."""
    least = max(peer[-1][0], plumb[-1][0])
    most = max(least, min(USELESS, max(peer[0][0], plumb[0][0])))
    errors = [least * (most / least) ** (i / (SAMPLES - 1)) for i in range(SAMPLES)]
    logs = [math.log(cost_at(peer, e) / cost_at(plumb, e)) for e in errors]
    return math.exp(sum(logs) / SAMPLES)


def read_case(out, case):
    """The metric that all engines have, the fronts by engine, Plumb first, and who is unable."""
    metric, unit, points, unable = None, "", {"Plumb": []}, {}
    for path in sorted(glob.glob(f"{out}/{case}.accuracy_*.csv")):
        for row in rows(path):
            if row["status"] == "unable":
                unable[row["engine"]] = row["note"]
                continue
            metric = metric or row["metric"]
            if row["metric"] != metric:
                continue
            unit = row["unit"]
            engine = points.setdefault(row["engine"], [])
            if row["status"] == "done":
                engine.append((float(row["error"]), float(row["cost_us_per_s"])))
    for row in rows(f"{out}/plumb/{case}/points.csv"):
        if row["status"] == "done":
            metric, unit = metric or row["metric"], unit or row["unit"]
            errors = dict(pair.split("=") for pair in row["others"].split())
            errors[row["metric"]] = row["error"]
            points["Plumb"].append((float(errors[metric]), float(row["us_per_s"])))
    fronts = {engine: front(found) for engine, found in points.items()}
    for engine in [e for e, line in fronts.items() if not line]:
        unable[engine] = "no run was good"
        del fronts[engine]
    return metric, unit, fronts, unable


def style(engines, engine):
    width, point = (3, 0.7) if engine == "Plumb" else (1.5, 0.3)
    return f"with linespoints lw {width} pt 7 ps {point} lc '{COLOURS[engines.index(engine) % len(COLOURS)]}'"


def write_chart(out, charts, engines):
    """A panel for each case, and one for the key."""
    columns = min(4, len(charts) + 1)
    lines = -(-(len(charts) + 1) // columns)
    with open(f"{out}/chart.gp", "w") as gp:
        gp.write(f"set terminal svg size {380 * columns},{300 * lines} font 'sans,11' background 'white'\n"
                 f"set output '{out}/accuracy.svg'\n"
                 f"set multiplot layout {lines},{columns}\n"
                 "set logscale xy\nset format '10^{%T}'\nset grid lc '#cccccc'\nunset key\n"
                 "set xlabel 'CPU time [µs per simulated s]' font ',9'\n")
        for case, (metric, unit, fronts, _) in charts.items():
            gp.write(f"set title '{case}: {metric}{' [' + unit + ']' if unit else ''}' noenhanced\n")
            errors = [e for line in fronts.values() for e, _ in line]
            gp.write(f"set yrange [{min(errors) / 4}:{max(errors) * 4}]\n")  # points on an edge are not seen
            plots = []
            for engine, line in reversed(fronts.items()):  # Plumb above the others
                block = f"${case}_{engine}".replace(" ", "_")
                gp.write(f"{block} << EOD\n" + "".join(f"{c} {e}\n" for e, c in line) + "EOD\n")
                plots.append(f"{block} using 1:2 {style(engines, engine)}")
            gp.write("plot " + ", ".join(plots) + "\n")
        gp.write("unset border\nunset tics\nunset xlabel\nunset title\nset key center center\nset autoscale\nplot [1:2][1:2] "
                 + ", ".join(f"NaN {style(engines, e)} title '{e}'" for e in engines) + "\n")


def main(out, cases):
    charts = {case: read_case(out, case) for case in cases}
    only_plumb = [case for case, (_, _, fronts, _) in charts.items() if list(fronts) == ["Plumb"]]
    charts = {case: chart for case, chart in charts.items() if case not in only_plumb}
    engines = ["Plumb"] + sorted({e for c in charts.values() for e in c[2] if e != "Plumb"})
    print("ratio: the engine's CPU time over Plumb's, the geometric mean over the errors up to "
          f"{USELESS} that both keep within; above 1 Plumb is ahead")
    print(f"{'case':16} {'engine':20} {'ratio':>9} {'least error':>12} {'of Plumb':>12}  finer alone")
    behind, finer, wins = {}, [], {engine: [] for engine in engines[1:]}
    for case, (_, _, fronts, unable) in charts.items():
        if "Plumb" not in fronts:
            print(f"{case:16} Plumb has no good run")
            behind[case] = ["has no good run"]
            continue
        plumb = fronts["Plumb"]
        for engine in sorted(e for e in fronts if e != "Plumb"):
            line = fronts[engine]
            least, own = line[-1][0], plumb[-1][0]
            if least > USELESS:
                print(f"{case:16} {engine:20} {'-':>9} {least:12.2g} {own:12.2g}  Plumb")
                wins[engine].append(True)
                continue
            times = ratio(line, plumb)
            alone = "Plumb" if own < least else engine if least < own else "-"
            print(f"{case:16} {engine:20} {times:9.3g} {least:12.2g} {own:12.2g}  {alone}")
            wins[engine].append(times > 1)
            if times <= 1:
                behind.setdefault(case, []).append(f"{engine} {times:.2g}")
            if alone == engine:
                finer.append(f"{case} ({engine})")
        for engine, reason in unable.items():
            print(f"{case:16} {engine:20} {reason}")
    for engine, won in wins.items():
        print(f"against {engine}: ahead on {sum(won)} of {len(won)} cases")
    print(f"No other engine does: {', '.join(only_plumb) or 'none'}")
    print(f"Another alone reaches the least errors on: {'; '.join(finer) or 'none'}")
    print(f"Plumb's front is ahead of all on {len(charts) - len(behind)} of {len(charts)} cases; behind on: "
          + ("; ".join(f"{case} ({', '.join(by)})" for case, by in behind.items()) or "none"))
    write_chart(out, charts, engines)


main(sys.argv[1], sys.argv[2:])
