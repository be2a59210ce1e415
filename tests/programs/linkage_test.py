"""tests/programs/linkage_test.py: what the programs and modules load when they start."""
import re
import subprocess
import sys
import unittest

from programs import BIN, SOURCE, main

sys.path.insert(0, str(SOURCE / "tests"))
import layering_test  # noqa: E402

PROGRAMS = [BIN / f"kinora-{name}" for name in ("render", "shade", "validate", "convert")]
ON_DEMAND = re.compile(
    r"lib(embree|tbb|OpenEXR|Imath|OpenImageIO|png|deflate|zip|xml2|capstone|xxhash|icu|crypto)")
MODULES = sorted((BIN.parent / "lib").glob("*.so"))


def libraries(file):
    """Names of all libraries that the dynamic linker loads for a file."""
    done = subprocess.run(["ldd", file], capture_output=True, text=True, check=True)
    names = re.findall(r"^\s*(?:\S*/)?(lib[^\s/]+)", done.stdout, re.M)
    assert any(name.startswith("libc.so") for name in names), done.stdout
    return names


class Linkage(unittest.TestCase):
    def test_what_a_start_does_not_need_is_not_loaded(self):
        """A version, a help text or a validation uses none of these (opened_libraries_test.py)."""
        for file in PROGRAMS:
            with self.subTest(file.name):
                self.assertEqual([name for name in libraries(file) if ON_DEMAND.match(name)], [])

    def test_the_modules_load_them(self):  # or the names above mean nothing
        for module, wanted in (("exr", "libOpenEXR"), ("images", "libOpenImageIO"),
                               ("tasks", "libtbb")):
            names = libraries(BIN.parent / f"lib/libkinora_{module}.so")
            self.assertTrue(any(name.startswith(wanted) for name in names), names)

    def test_nothing_links_llvm(self):
        self.assertTrue(MODULES)
        for file in (*PROGRAMS, *MODULES):
            with self.subTest(file.name):
                self.assertEqual([n for n in libraries(file) if re.match(r"lib(LLVM|clang)", n)], [])

    def test_no_program_has_planted_faults(self):
        def symbols(file):
            done = subprocess.run(["nm", "-C", file], capture_output=True, text=True, check=True)
            return done.stdout.count("planted_fault")

        self.assertGreater(symbols(BIN.parent / "tests/jit_planted_fault_test"), 0)
        self.assertEqual([file.name for file in PROGRAMS if symbols(file)], [])


def symbols_of(archive):
    """What a static library defines and what of ours it leaves open."""
    done = subprocess.run(["nm", "--no-sort", archive], capture_output=True, text=True, check=True)
    defined, wanted = set(), set()
    for kind, name in re.findall(r"^[0-9a-f ]{16} (\w) (\S+)", done.stdout, re.M):
        (wanted if kind == "U" else defined).add(name)
    return defined, {name for name in wanted - defined if name.startswith("_ZN6kinora")}


class Rooms(unittest.TestCase):
    """A room calls only what the rooms on its CMake line define, directly or through them."""

    def test_rooms_link_what_they_name(self):
        targets = layering_test.read_targets()
        archives = {file.stem[3:]: symbols_of(file) for file in BIN.parent.rglob("libkinora_*.a")
                    if "tests" not in file.relative_to(BIN.parent).parts}
        self.assertGreater(len(archives), 30)
        for name, (_, wanted) in sorted(archives.items()):
            with self.subTest(name):
                for link in links_below(name, targets, set()):
                    wanted = wanted - archives.get(link, (set(), set()))[0]
                self.assertEqual(sorted(wanted), [])


def links_below(name, targets, seen):
    for link in targets[name].links if name in targets else []:
        if link not in seen:
            seen.add(link)
            links_below(link, targets, seen)
    return seen


if __name__ == "__main__":
    main()
