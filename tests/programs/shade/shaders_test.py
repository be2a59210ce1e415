"""tests/programs/shade/shaders_test.py: the shaders of assets: clean, described, and using the whole
language between them."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import SHADERS, SOURCE, ProgramTest, main, shade

FILES = sorted(SHADERS.rglob("*.sl"))
STANDARD = ("constant matte metal shinymetal plastic paintedplastic ambientlight distantlight "
            "pointlight spotlight").split()
# Text that shows a construct in use; what words.def holds is looked for as a word.
CONSTRUCTS = {
    "#include": r"#include \"", "#define": r"#define \w+ ", "macro with arguments": r"#define \w+\(",
    "function": r"^(float|color|point|void) \w+\(", "nested function": r"^    (float|color) \w+\(.*\{",
    "several returns": r"return[^}]*\}[^}]*return|return color", "condition operator": r"\?[^;]*:",
    "array": r"\w+\[\d+\] = \{", "array parameter": r"\[\d+\] = \{[^}]*\};\)",
    "component": r"\w\[0\]", "matrix": r"matrix \w+ = ", "comma-style parameters": r"= [\d.]+, \w+ = ",
    "output parameter of a shader": r"output (float|string) __\w+",
    "point in a space": r'point "\w+" \(', "vector in a space": r'vector "\w+" \(',
    "color in a space": r'color "hs\w" \(', "typed call": r"(vector|color|float) (cell)?noise\(",
    "cross product": r"\w \^ \w", "dot product": r"\w \. \w", "assigning operators": r"[-+*/]= ",
    "string comparison": r'(==|!=) "', "nested loops": r"for \(.*\n\s+for \(",
    "light category": r'illuminance\("', "cone of illuminance": r"illuminance\(P, \w+, ",
    "cone of illuminate": r"illuminate\(\w+, axis", "beam of solar": r"solar\(\w+, ",
    "spline with a basis": r'spline\("', "optional arguments": r'"blur", ', "channel": r"\[0\], ss",
    "noise of one number": r"noise\((beat|cell|[\d.]+ \* \w+)\)", "time": r"\btime\b",
    "du, dv": r"\bdu\b.*\bdv\b", "bump through calculatenormal": r"calculatenormal\(P [-+]",
}


def code_of(text):
    return re.sub(r"/\*.*?\*/|//[^\n]*", " ", text, flags=re.S)


class Shaders(ProgramTest):
    def setUp(self):
        super().setUp()
        self.all = "\n".join(code_of(file.read_text()) for file in FILES)

    def test_are_sixty_and_more_and_have_the_standard_ones(self):
        self.assertGreaterEqual(len(FILES), 60)
        for name in STANDARD:
            self.assertIn(SHADERS / f"{name}.sl", FILES)
        for kind in ("surface", "displacement", "light", "volume", "imager", "transformation"):
            self.assertRegex(self.all, rf"\b{kind}\s+\w+\s*\(")

    def test_are_clean(self):
        for file in FILES:
            with self.subTest(file=file.name):
                # All four models of COLLADA have the same parameters.
                model = ["-Wno-unused-parameter"] if file.stem.startswith("collada_") else []
                self.expect(shade("check", file, "-I", SHADERS / "include", *model), 0,
                            "0 errors, 0 warnings")

    def test_say_what_they_look_like(self):
        for file in FILES:
            with self.subTest(file=file.name):
                self.assertRegex(file.read_text(), rf"^/\* {re.escape(file.name)}: ")

    def test_have_a_file_each_of_their_own_name(self):
        for file in FILES:
            with self.subTest(file=file.name):
                self.assertRegex(code_of(file.read_text()), rf"\b{file.stem}\s*\(")
        names = [file.stem for file in FILES]
        self.assertEqual(len(names), len(set(names)))

    def test_use_every_built_in(self):
        rows = re.findall(r"^(\w+) {2,}(.*)", shade("manual").out, re.M)
        self.assertGreater(len(rows), 60)
        names = re.findall(r"^GLOBAL\((\w+),", (SOURCE / "rsl/model/globals.def").read_text(), re.M)
        unused = sorted({name for name, doc in rows if not re.search("not supported|Not computed", doc) and name not in names
                         and not re.search(rf"\b{name}\s*\(", self.all)})
        self.assertEqual(unused, [])

    def test_use_every_word_of_the_grammar(self):
        words = re.findall(r'WORD\(\w+, "(\w+)"\)', (SOURCE / "rsl/text/words.def").read_text())
        self.assertEqual([word for word in words if not re.search(rf"\b{word}\b", self.all)],
                         [])

    def test_use_every_global(self):
        names = re.findall(r"^GLOBAL\((\w+),", (SOURCE / "rsl/model/globals.def").read_text(), re.M)
        self.assertEqual([name for name in names if not re.search(rf"\b{name}\b", self.all)], [])

    def test_use_every_construct(self):
        self.assertEqual([name for name, text in CONSTRUCTS.items()
                          if not re.search(text, self.all, re.M)], [])


if __name__ == "__main__":
    main()
