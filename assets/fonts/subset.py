"""Cuts Inter and Noto Sans SC (SIL Open Font License 1.1) and Phosphor (MIT) down to what the window and reports write.

    pip install fonttools
    python3 subset.py FOLDER      # FOLDER holds Inter's static Regular and SemiBold and Phosphor's regular as .ttf, and
                                  # NotoSansCJK-Regular.ttc

Of Inter it keeps Latin, Greek, arrows, mathematics and simple shapes, without hinting, which egui does not
use. Digits and signs take their tabular forms for good, because egui asks for no OpenType
features: numbers in a column must stand under each other. Of Noto Sans SC it keeps what the Chinese catalogue has, and for
people's own names the 6763 characters of GB 2312 with its signs.
"""

import sys
from pathlib import Path

from fontTools import subset
from fontTools.ttLib import TTCollection, TTFont

KEPT = [
    (0x20, 0x7E),
    (0xA0, 0x17F),
    (0x370, 0x3FF),
    (0x2010, 0x2027),
    (0x2030, 0x203A),
    (0x2070, 0x209C),
    (0x2190, 0x2199),
    (0x2200, 0x22FF),
    (0x25A0, 0x25FF),
    (0x2713, 0x2717),
]


def tabular(font):
    """Maps every character to its tabular form."""
    table = font["GSUB"].table
    lookups = [
        index
        for record in table.FeatureList.FeatureRecord
        if record.FeatureTag == "tnum"
        for index in record.Feature.LookupListIndex
    ]
    swap = {}
    for index in lookups:
        for sub in table.LookupList.Lookup[index].SubTable:
            sub = getattr(sub, "ExtSubTable", sub)
            swap.update(getattr(sub, "mapping", {}))
    for cmap in font["cmap"].tables:
        for code, glyph in list(cmap.cmap.items()):
            if chr(code).isdigit() or chr(code) in "+−.,":
                cmap.cmap[code] = swap.get(glyph, glyph)


def cut(source, target):
    """Writes the part of `source` that is kept."""
    font = TTFont(source)
    tabular(font)
    options = subset.Options(layout_features=["kern", "mark"], hinting=False, notdef_outline=True)
    options.name_IDs = [0, 1, 2, 4, 5, 6, 13, 14]
    cutter = subset.Subsetter(options)
    cutter.populate(unicodes=[code for a, b in KEPT for code in range(a, b + 1)])
    cutter.subset(font)
    font.save(target)


def chinese(catalogue):
    """The characters that are kept of Noto Sans SC."""
    kept = {c for c in catalogue if ord(c) >= 0x2E80}
    for first in [*range(0xA1, 0xA4), *range(0xB0, 0xF8)]:
        for second in range(0xA1, 0xFF):
            kept.update(bytes([first, second]).decode("gb2312", "ignore"))
    return kept


def cut_chinese(source, target, catalogue):
    """Writes the part of the simplified Chinese face of a collection that is kept."""
    faces = TTCollection(source).fonts
    font = next(f for f in faces if f["name"].getDebugName(4) == "Noto Sans CJK SC")
    options = subset.Options(layout_features=[], hinting=False, notdef_outline=True)
    options.name_IDs = [0, 1, 2, 4, 5, 6, 13, 14]
    options.drop_tables += ["vhea", "vmtx", "VORG", "BASE", "GPOS", "GSUB"]
    cutter = subset.Subsetter(options)
    cutter.populate(unicodes=[ord(c) for c in chinese(catalogue)])
    cutter.subset(font)
    font.save(target)


# Undo, redo, save, table, copy, fit, side, grip (src/gui/widgets/buttons.rs).
ICONS = [0xE08A, 0xE08C, 0xE20C, 0xE476, 0xE1CA, 0xE1D0, 0xEC24, 0xEAE2]


def cut_icons(source, target):
    """Writes the icons that the window has."""
    font = TTFont(source)
    options = subset.Options(layout_features=[], hinting=False, notdef_outline=True)
    options.name_IDs = [0, 1, 2, 4, 5, 6, 13, 14]
    options.drop_tables += ["GSUB", "GPOS"]
    cutter = subset.Subsetter(options)
    cutter.populate(unicodes=ICONS)
    cutter.subset(font)
    font.save(target)


def main():
    folder = Path(sys.argv[1])
    here = Path(__file__).parent
    catalogue = (here.parent / "languages" / "zh.po").read_text(encoding="utf-8")
    collection = next(folder.rglob("NotoSansCJK-Regular.ttc"))
    cut_chinese(collection, here / "NotoSansSC-Regular.otf", catalogue)
    cut_icons(next(folder.rglob("Phosphor.ttf")), here / "Phosphor.ttf")
    for weight in ("Regular", "SemiBold"):
        source = next(p for p in folder.rglob(f"*{weight}.ttf"))
        cut(source, here / f"Inter-{weight}.ttf")


main()
