#!/usr/bin/env python3
"""tests/conformance/make.py FOLDER: writes equal/FAMILY/NAME.dae and differ/FAMILY/NAME.dae there.

The build writes them to build/PRESET/test_data/conformance. tests/programs/pairs_test.py renders
them: files of one folder of equal/ look alike, no two of one of differ/ do. Names with a '/' are
parts that others refer to.
"""
import io
import shutil
import sys
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import differ_pairs  # noqa: E402
import equal_pairs  # noqa: E402

KINDS = {"equal": equal_pairs, "differ": differ_pairs}


def zipped(members):
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in members.items():
            archive.writestr(zipfile.ZipInfo(name, (2026, 11, 21, 0, 0, 0)), content,
                             zipfile.ZIP_DEFLATED)
    return data.getvalue()


def files():
    """Path below the folder -> bytes."""
    found = {}
    for kind, module in KINDS.items():
        for family, make in module.FAMILIES.items():
            for name, content in make().items():
                suffix = "" if isinstance(content, (bytes, dict)) else ".dae"
                if isinstance(content, dict):
                    content = zipped(content)
                if isinstance(content, str):
                    content = content.encode()
                found[f"{kind}/{family}/{name}{suffix}"] = content
    return found


def main():
    folder = Path(sys.argv[1])
    made = files()
    shutil.rmtree(folder, ignore_errors=True)
    for name, content in made.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    print(f"{len(made)} files in {folder}")


if __name__ == "__main__":
    main()
