"""The plots of the mesher benchmark as SVG, without any library."""
import math

INK, PALE, GRID = "#222222", "#666666", "#dddddd"
COLOURS = {"voxtet": "#c2410c", "voxtet_wasm": "#f59e0b", "tetgen_paper": "#94a3b8", "tetgen_angles": "#475569",
           "netgen": "#7c3aed", "gmsh_delaunay": "#0891b2", "gmsh_hxt": "#1d4ed8", "cgal": "#15803d"}


LOWEST, HIGHEST = -6, -1  # decades of the shares drawn


def text(x, y, words, size=11, anchor="start", colour=INK):
    words = words.replace("&", "&amp;").replace("<", "&lt;")
    return f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" text-anchor="{anchor}" fill="{colour}">{words}</text>'


def line(x1, y1, x2, y2, colour=GRID, width=1):
    return f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}" stroke-width="{width}"/>'


def svg(width, height, parts):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
            f'font-family="sans-serif">\n<rect width="{width}" height="{height}" fill="white"/>\n' + "\n".join(parts) + "\n</svg>\n")


def histogram(row, left, top, width, height):
    """Shares of tetrahedra by smallest dihedral angle, logarithmic: the tail decides."""
    found = row["shapes"]["min_dihedral_deg"]
    bins, total = found["histogram"], sum(found["histogram"]["counts"])
    path, step = f"M{left:.1f} {top + height:.1f}", width / len(bins["counts"])
    for count in bins["counts"]:
        share = math.log10(count / total) if count else LOWEST
        path += f"V{top + height * (1 - max(0, share - LOWEST) / (HIGHEST - LOWEST)):.1f}h{step:.2f}"
    at = left + width * (found["min"] - bins["lo"]) / (bins["hi"] - bins["lo"])
    return [f'<path d="{path}V{top + height:.1f}Z" fill="{COLOURS[row["mesher"]]}"/>', line(at, top + 4, at, top + height, INK),
            text(at - 3, top + 12, f"{found['min']:.1f}°", 10, "end")]


def distributions(cases, names):
    """A row a mesher, a column a case, all on one scale."""
    side, wide, tall, gap, head = 190, 200, 62, 14, 40
    meshers = [m for m in names if m != "voxtet_wasm"]  # the same meshes as native
    width, height = side + len(cases) * (wide + gap), head + len(meshers) * (tall + gap) + 40
    parts = [text(10, 18, "Smallest dihedral angle of each tetrahedron; share of them, logarithmic from one in a million to one in ten", 12)]
    bottom = head + len(meshers) * (tall + gap) - gap
    for column, case in enumerate(cases):
        left = side + column * (wide + gap)
        parts.append(text(left + wide / 2, head - 6, case["volume"], 11, "middle"))
        for degrees in range(0, 76, 15):
            x = left + wide * degrees / 75
            parts += [line(x, head, x, bottom), text(x, bottom + 14, f"{degrees}°", 10, "middle", PALE)]
        for index, mesher in enumerate(meshers):
            top = head + index * (tall + gap)
            parts.append(line(left, top + tall, left + wide, top + tall, PALE))
            row = next((r for r in case["rows"] if r["mesher"] == mesher), {})
            parts += histogram(row, left, top, wide, tall) if "tets" in row else [text(left + 8, top + tall - 8, "no mesh", 10, colour=PALE)]
    for index, mesher in enumerate(meshers):
        words, y = names[mesher].split(", ")[0].split(" "), head + index * (tall + gap) + tall / 2
        parts += [text(10, y, " ".join(words[:2]), 11), text(10, y + 14, " ".join(words[2:]), 10, colour=PALE)]
    return svg(width, height, parts)


def speed(points, names):
    """Volume to mesh: tetrahedra a second against the smallest dihedral angle, a dot a case. (mesher, rate, degrees)"""
    left, top, wide, tall = 60, 40, 560, 360
    rates = [rate for _, rate, _ in points] or [1]
    low, high = math.floor(math.log10(min(rates))), math.ceil(math.log10(max(rates)))
    high = max(high, low + 1)
    most = 10 * math.ceil(max([degrees for _, _, degrees in points] + [30]) / 10)
    parts = [text(10, 18, "Volume to mesh, one thread: smallest dihedral angle against tetrahedra a second; a dot a case", 12)]
    for decade in range(low, high + 1):
        for digit in (1, 2, 5):
            value = math.log10(digit) + decade
            if value > high:
                continue
            x = left + wide * (value - low) / (high - low)
            parts += [line(x, top, x, top + tall), text(x, top + tall + 16, f"{digit * 10 ** decade:,}", 10, "middle", PALE)]
    for degrees in range(0, most + 1, 5):
        y = top + tall * (1 - degrees / most)
        parts += [line(left, y, left + wide, y), text(left - 6, y + 4, f"{degrees}°", 10, "end", PALE)]
    for mesher, rate, degrees in reversed(points):  # the first mesher on top
        x, y = left + wide * (math.log10(rate) - low) / (high - low), top + tall * (1 - degrees / most)
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="5" fill="{COLOURS[mesher]}" stroke="white"/>')
    for index, mesher in enumerate(names):
        y = top + 10 + 18 * index
        parts += [f'<circle cx="{left + wide + 20}" cy="{y}" r="5" fill="{COLOURS[mesher]}"/>', text(left + wide + 30, y + 4, names[mesher])]
    return svg(left + wide + 260, top + tall + 30, parts)
