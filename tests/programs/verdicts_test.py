"""tests/programs/verdicts_test.py: what kinora-validate calls an error by default, and what it does not:
each row is a change of a good document."""
import sys

from programs import SOURCE, ProgramTest, main, run

sys.path[:0] = [str(SOURCE / "tests/conformance")]
import dae  # noqa: E402

GOOD = dae.textured()
TRIANGLES = 'triangles count="'

# What stands in the document, what instead, the code of the error.
WRONG = [
    ('url="#house"', 'url="#cottage"', "LINK_UNRESOLVED"),
    ('url="#eye"', 'url="#nose"', "LINK_UNRESOLVED"),
    ('url="#sun"', 'url="#moon"', "LINK_UNRESOLVED"),
    ('target="#mat"', 'target="#rug"', "LINK_UNRESOLVED"),
    ('url="#fx"', 'url="#gx"', "LINK_UNRESOLVED"),
    ('url="#scene"', 'url="#play"', "LINK_UNRESOLVED"),
    ('source="#house-v"', 'source="#home-v"', "LINK_UNRESOLVED"),
    ('source="#house-n"', 'source="#home-n"', "LINK_UNRESOLVED"),
    ('version="1.4.1"', 'version="1.3.0"', "DOC_VERSION"),
    ('version="1.4.1"', 'version="2.0"', "DOC_VERSION"),
    ('version="1.4.1"', 'version=""', "DOC_VERSION"),
    ("<p>", "<p>0 ", "PRIM_P_COUNT"),
    ("<p>", "<p>99999 0 0 ", "PRIM_INDEX_RANGE"),
    ("<p>", "<p>-1 0 0 ", "PRIM_INDEX_NEGATIVE"),
    (TRIANGLES, 'triangles count="1', "PRIM_COUNT"),
    (TRIANGLES, 'triangles count="-', "SRC_ATTRIBUTE"),
    (TRIANGLES, 'triangles number="', "SRC_ATTRIBUTE"),
    ('stride="3"', 'stride="0"', "SRC_STRIDE"),
    ('stride="3"', 'stride="1"', "SRC_STRIDE"),
    ('stride="3"', 'stride="-3"', "SRC_ATTRIBUTE"),
    ('stride="3"', 'stride="4000000000"', "SRC_ACCESSOR_COUNT"),
    (' stride="3"', "", "SRC_ATTRIBUTE"),
    ('accessor source="#house-p-array" count="', 'accessor source="#house-p-array" count="9', "SRC_ACCESSOR_COUNT"),
    ('float_array id="house-p-array" count="', 'float_array id="house-p-array" count="9', "SRC_COUNT"),
    ('float_array id="house-p-array" count="', 'float_array id="house-p-array" amount="', "SRC_ATTRIBUTE"),
    ('semantic="POSITION"', 'semantic="PLACE"', "PRIM_NO_POSITION"),
    ('semantic="VERTEX"', 'semantic="CORNER"', "PRIM_NO_VERTEX"),
]

NAMES = ('<source id="names"><Name_array id="names-a" count="2">a b</Name_array><technique_common>'
         '<accessor source="#names-a" count="2"><param name="N" type="Name"/></accessor>'
         '</technique_common></source><vertices ')

# What every reader accepts.
RIGHT = [
    ("map.png", "../map.png"),
    ("map.png", "../materials/textures/map.png"),
    ("<vertices ", NAMES),
]




def identifiers(id, names, param):
    """A <source> of sids."""
    return (f'<source id="{id}"><SIDREF_array id="{id}-a" count="{len(names)}">{" ".join(names)}</SIDREF_array>'
            f'<technique_common><accessor source="#{id}-a" count="{len(names)}" stride="1"><param name="{param}" '
            'type="SIDREF"/></accessor></technique_common></source>')


def numbers(id, values, params):
    words = values.split()
    return (f'<source id="{id}"><float_array id="{id}-a" count="{len(words)}">{values}</float_array><technique_common>'
            f'<accessor source="#{id}-a" count="{len(words) // len(params)}" stride="{len(params)}">'
            + "".join(f'<param name="{p}" type="float"/>' for p in params) + "</accessor></technique_common></source>")


def line(sid, origin, direction):
    return f'<curve sid="{sid}"><line><origin>{origin}</origin><direction>{direction}</direction></line></curve>'


# COLLADA 1.5, chapter 9: a square of four lines in a plane; inputs lead to sources, <vertices> and to other parts of the <brep>.
BREP = ('<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2008/03/COLLADASchema" version="1.5.0"><asset>'
        "<created>2026-01-01T00:00:00Z</created><modified>2026-01-01T00:00:00Z</modified></asset>"
        '<library_geometries><geometry id="square"><brep><curves>'
        + line("a", "0 0 0", "1 0 0") + line("b", "1 0 0", "0 1 0") + line("c", "1 1 0", "-1 0 0") + line("d", "0 1 0", "0 -1 0")
        + '</curves><surfaces><surface sid="s"><plane><equation>0 0 1 0</equation></plane></surface></surfaces>'
        + identifiers("lines", [f"square/{sid}" for sid in "abcd"], "CURVE") + identifiers("planes", ["square/s"], "SURFACE")
        + numbers("corners", "0 0 0 1 0 0 1 1 0 0 1 0", "XYZ") + numbers("range", "0 1", ["PARAM"])
        + '<source id="ways"><Name_array id="ways-a" count="2">FORWARD REVERSED</Name_array><technique_common>'
        '<accessor source="#ways-a" count="2" stride="1"><param name="ORIENTATION" type="name"/></accessor></technique_common>'
        '</source><vertices id="points"><input semantic="POSITION" source="#corners"/></vertices>'
        '<edges id="edges" count="4"><input semantic="CURVE" source="#lines" offset="0"/>'
        '<input semantic="VERTEX" source="#points" offset="1"/><input semantic="VERTEX" source="#points" offset="2"/>'
        '<input semantic="PARAM" source="#range" offset="3"/><input semantic="PARAM" source="#range" offset="4"/>'
        "<p>0 0 1 0 1 1 1 2 0 1 2 2 3 0 1 3 3 0 0 1</p></edges>"
        '<wires id="wires" count="1"><input semantic="EDGE" source="#edges" offset="0"/>'
        '<input semantic="EDGE_ORIENTATION" source="#ways" offset="1"/><vcount>4</vcount><p>0 0 1 0 2 0 3 0</p></wires>'
        '<faces id="faces" count="1"><input semantic="SURFACE" source="#planes" offset="0"/>'
        '<input semantic="WIRE" source="#wires" offset="1"/><input semantic="WIRE_ORIENTATION" source="#ways" offset="2"/>'
        "<vcount>1</vcount><p>0 0 0</p></faces>"
        '<shells id="shells" count="1"><input semantic="FACE" source="#faces" offset="0"/>'
        '<input semantic="FACE_ORIENTATION" source="#ways" offset="1"/><vcount>1</vcount><p>0 0</p></shells>'
        '<solids id="solids" count="1"><input semantic="SHELL" source="#shells" offset="0"/>'
        '<input semantic="SHELL_ORIENTATION" source="#ways" offset="1"/><vcount>1</vcount><p>0 0</p></solids>'
        '</brep></geometry></library_geometries><library_visual_scenes><visual_scene id="vs"><node>'
        '<instance_geometry url="#square"/></node></visual_scene></library_visual_scenes>'
        '<scene><instance_visual_scene url="#vs"/></scene></COLLADA>')


class Verdicts(ProgramTest):
    def test_inputs_of_a_brep_lead_to_its_parts(self):
        self.expect(self.validate(BREP), 0)
        for input, part in (("EDGE", "edges"), ("WIRE", "wires"), ("FACE", "faces"), ("SHELL", "shells"),
                            ("CURVE", "lines"), ("VERTEX", "points")):
            with self.subTest(input):
                old = f'semantic="{input}" source="#{part}"'
                self.assertIn(old, BREP)
                wrong = self.validate(BREP.replace(old, f'semantic="{input}" source="#gone"', 1))
                self.expect(wrong, 1, "LINK_UNRESOLVED")

    def validate(self, text, name="a/b/scene.dae", *words):
        return run("kinora-validate", *words, self.write(name, text))

    def test_the_base_is_good(self):
        self.expect(self.validate(GOOD), 0)

    def test_what_breaks_a_scene_is_an_error(self):
        for old, new, code in WRONG:
            with self.subTest(old=old, new=new):
                self.assertIn(old, GOOD)
                result = self.validate(GOOD.replace(old, new, 1))
                self.expect(result, 1, code)
                errors = [line for line in result.out.split("\n") if " error: " in line]
                self.assertTrue(any(f"[{code}]" in line for line in errors), result)

    def test_what_readers_accept_is_none(self):
        for old, new in RIGHT:
            with self.subTest(new=new):
                self.assertIn(old, GOOD)
                self.expect(self.validate(GOOD.replace(old, new, 1)), 0)
        used = GOOD.replace("<vertices ", NAMES, 1).replace(
            '<input semantic="NORMAL"', '<input semantic="LABEL" source="#names" offset="0"/><input semantic="NORMAL"', 1)
        self.assertIn("LABEL", used)
        self.expect(self.validate(used), 0)

    def test_a_skeleton_may_be_a_whole_scene(self):
        scene = SOURCE / "assets/scenes/walker.dae"
        text = scene.read_text()
        begin = text.index("<skeleton>")
        end = text.index("</skeleton>", begin)
        id = text[text.index("<visual_scene id=") + 18:].split('"')[0]
        whole = text[:begin] + f"<skeleton>#{id}" + text[end:]
        self.expect(self.validate(whole, "walker.dae"), run("kinora-validate", scene).code)
        self.assertNotIn("LINK_WRONG_TYPE", self.validate(whole, "walker.dae").out)

    def test_a_directory_s_files_may_name_what_is_in_it(self):
        holds = dict(scene=False, lights="", cameras="", materials="", effects="")
        self.write("all/parts/house.dae", dae.document("", **holds))
        scene = self.write("all/scene/main.dae", dae.document(
            dae.node(dae.shown("../parts/house.dae#house")), geometries=" "))
        self.expect(run("kinora-validate", scene), 1, "LINK_OUTSIDE")
        result = run("kinora-validate", "-r", self.folder / "all")
        self.assertNotIn("LINK_OUTSIDE", result.out)
        self.expect(run("kinora-validate", "-r", self.folder / "all/scene"), 1, "LINK_OUTSIDE")

    def test_the_default_profile_has_a_name(self):
        text = GOOD.replace('url="#house"', 'url="#cottage"', 1)
        plain = self.validate(text)
        named = self.validate(text, "a/b/scene.dae", "--profile", "default")
        self.assertEqual((plain.code, plain.out), (named.code, named.out))


if __name__ == "__main__":
    main()
