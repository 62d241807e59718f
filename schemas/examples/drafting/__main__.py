# SPDX-License-Identifier: GPL-3.0-or-later
"""Drafts every example garment and writes it as NAME.json into the folder given (default: schemas/examples)."""
import json
import pathlib
import re
import sys

import skirts
import tops
import trousers

GARMENTS = {"a_line_skirt": skirts.a_line_skirt, "dress": tops.dress, "leggings": trousers.leggings,
            "t_shirt": tops.t_shirt, "trousers": trousers.trousers}


def text(document):
    """JSON with one line for every innermost list or object."""
    indented = json.dumps(document, indent=1)
    inner = re.compile(r"([\[{])\s+([^\[\]{}]*?)\s+([\]}])")
    indented = inner.sub(lambda m: m[1] + re.sub(r"\s*\n\s*", " ", m[2]) + m[3], indented)
    nested = re.compile(r"\[\s+(\[[^\[\]{}\n]*\](?:,\s+\[[^\[\]{}\n]*\])*)\s+\]")
    return nested.sub(lambda m: "[" + re.sub(r"\s*\n\s*", " ", m[1]) + "]", indented) + "\n"


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parents[1]
    for name, draft in GARMENTS.items():
        (folder / f"{name}.json").write_text(text(draft().document()))


main()
