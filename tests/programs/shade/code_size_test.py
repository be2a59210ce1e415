"""tests/programs/shade/code_size_test.py: what jit and rsl take of the stripped kinora-shade, read
from the map that its linker wrote."""
import os
import re
import unittest
from collections import Counter
from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import BIN, main

# Bytes of jit and rsl: two MiB, a quarter for the classes and co-shaders of RSL 2.0, and an eighth for its
# integrators and the lights that send samples. A build file by file
# keeps more functions that are called once: it weighs 6 % more than one of whole rooms, which is CI's.
MOST_BY_ROOMS, MOST = 19 << 17, 5 << 19


def is_by_rooms():
    cache = (Path(BIN).parent / "CMakeCache.txt").read_text()
    return re.search(r"^CMAKE_UNITY_BUILD:\w+=(ON|TRUE|1)$", cache, re.M) is not None
LOADED = (".text", ".rodata", ".data", ".eh_frame", ".gcc_except_table", ".init_array", ".bss", ".tbss")


def sizes(link_map):
    """Bytes that stay in the stripped program, by the library or object they come from."""
    by_origin = Counter()
    text = link_map.read_text(errors="replace")
    text = text[text.index("Linker script and memory map"):]
    # " .text._ZN3foo  0xADDRESS  0xSIZE  FILE", broken behind long section names
    row = re.compile(r"^ (\.[\w.$-]+)\s+0x([0-9a-f]+)\s+0x([0-9a-f]+) (\S.*)$", re.M)
    for section, address, size, origin in row.findall(re.sub(r"\n {10,}0x", " 0x", text)):
        if int(address, 16) and section.startswith(LOADED):
            by_origin[re.sub(r"\(.*", "", origin)] += int(size, 16)
    return by_origin


class CodeSize(unittest.TestCase):
    def test_jit_and_rsl_are_small(self):
        found = sizes(Path(BIN).parent / "kinora-shade.map")
        # each folder of jit and rsl is a library of its own
        parts = {name: sum(size for origin, size in found.items() if name in origin)
                 for name in ("libkinora_jit", "libkinora_rsl")}
        print("   " + ", ".join(f"{name} {size / 2**20:.3f} MB" for name, size in parts.items()))
        program = os.path.getsize(Path(BIN) / "kinora-shade")
        for size in parts.values():  # was the map understood?
            self.assertGreater(size, 200_000)
        self.assertLess(sum(found.values()), program)
        self.assertLess(sum(parts.values()), MOST_BY_ROOMS if is_by_rooms() else MOST)


if __name__ == "__main__":
    main()
