# SPDX-License-Identifier: GPL-3.0-or-later
"""read_dxf.py FILE.dxf EXPECTED.txt: reads the DXF with ezdxf, prints every audit error and every outline, notch or sew
line that is not where EXPECTED says within 0.01 mm; the exit code is 1 if there is any, 77 if ezdxf is not installed.
Lines of EXPECTED: block layer closed x y x y ...   (notches: block layer notch x y depth angle)"""
import sys

try:
    import ezdxf
except ImportError:
    sys.exit(77)

TOLERANCE = 0.0101  # mm; coordinates are written with two decimals, rounded


def close(a, b):
    return all(abs(x - y) <= TOLERANCE for x, y in zip(a, b)) and len(a) == len(b)


def main(dxf, expected):
    document = ezdxf.readfile(dxf)
    problems = [str(error) for error in document.audit().errors]
    inserts = {entity.dxf.name for entity in document.modelspace().query("INSERT")}
    chains, points = {}, {}
    for name in inserts:
        for entity in document.blocks.get(name):
            key = (name, entity.dxf.layer)
            if entity.dxftype() == "POLYLINE":
                chains.setdefault(key, []).append((entity.is_closed, [c for v in entity.vertices for c in (v.dxf.location.x, v.dxf.location.y)]))
            elif entity.dxftype() == "LINE":
                chains.setdefault(key, []).append((False, [entity.dxf.start.x, entity.dxf.start.y, entity.dxf.end.x, entity.dxf.end.y]))
            elif entity.dxftype() == "POINT":
                location = entity.dxf.location
                points.setdefault(key, []).append([location.x, location.y, location.z, entity.dxf.get("angle", 0.0)])
    checked = 0
    for line in open(expected):
        block, layer, kind, *numbers = line.split()
        numbers = [float(n) for n in numbers]
        if kind == "notch":
            found = any(close(p[:3], numbers[:3]) and abs(p[3] - numbers[3]) < 0.02 for p in points.get((block, layer), []))
        else:
            found = any(c == (kind == "closed") and close(p, numbers) for c, p in chains.get((block, layer), []))
        checked += 1
        if not found:
            problems.append(f"missing: {block} layer {layer} {kind} {numbers[:4]} ...")
    print(f"{checked} lines and notches checked, {len(problems)} problems")
    for problem in problems[:20]:
        print(problem)
    sys.exit(1 if problems or checked == 0 else 0)


main(sys.argv[1], sys.argv[2])
