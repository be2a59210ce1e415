"""tests/programs/wrong_documents_test.py: 65 documents with one fault each, in the manner of public collections of wrong COLLADA
files: kinora-validate, with its defaults, calls each an error. Each is a change of a base of tests/collada/rules."""
import re
import shutil

from programs import SOURCE, ProgramTest, main, run

BASES = SOURCE / "tests/collada/rules/bases"
FILES = SOURCE / "tests/collada/rules/beside/files"

# What is wrong, the base, what stands there (a regular expression), what instead.
WRONG = [
    # Links that lead nowhere, or to another kind of element.
    ("instance_geometry to nothing", "geometry", '"#quad"', '"#quads"'),
    ("instance_controller to nothing", "skin", 'url="#arm"', 'url="#leg"'),
    ("instance_light to nothing", "light", 'url="#lamp"', 'url="#candle"'),
    ("instance_camera to nothing", "camera", 'url="#eye"', 'url="#ear"'),
    ("instance_node to nothing", "geometry", "<instance_geometry", '<instance_node url="#other"/><instance_geometry'),
    ("instance_visual_scene to nothing", "geometry", 'scene url="#scene"', 'scene url="#play"'),
    ("instance_effect to nothing", "texture", 'url="#fx"', 'url="#gx"'),
    ("instance_material to nothing", "texture", 'target="#mat"', 'target="#rug"'),
    ("instance_geometry to a material", "texture", 'url="#quad"', 'url="#mat"'),
    ("instance_controller to a geometry", "skin", 'url="#arm"', 'url="#tri"'),
    ("instance_geometry without url", "geometry", 'instance_geometry url="#quad"', "instance_geometry"),
    ("skin of nothing", "skin", 'skin source="#tri"', 'skin source="#square"'),
    ("morph of nothing", "morph", 'source="#base"', 'source="#bass"'),
    ("morph to a target that is not there", "morph", ">wide<", ">tall<"),
    ("skeleton that is not there", "skin", ">#upper-node<", ">#knee<"),
    ("joint that is not there", "skin", ">upper lower<", ">upper toe<"),
    ("channel of a sampler that is not there", "linear_animation", 'channel source="#sampler"', 'channel source="#curve"'),
    ("channel to a node that is not there", "linear_animation", "root/move.X", "branch/move.X"),
    ("channel to a sid that is not there", "linear_animation", "root/move.X", "root/turn.X"),
    ("input of a source that is not there", "geometry", 'source="#pos"/>', 'source="#position"/>'),
    ("accessor of an array that is not there", "geometry", 'accessor source="#pos-array"', 'accessor source="#pos-list"'),
    ("texture of a sampler that is not there", "texture", 'texture="sampler"', 'texture="sampled"'),
    ("sampler of a surface that is not there", "texture", "<source>surface", "<source>plane"),
    ("surface of an image that is not there", "texture", "<init_from>img<", "<init_from>imagine<"),
    # Counts, strides and indices.
    ("array without count", "geometry", ' count="12"', ""),
    ("array that is shorter than it says", "geometry", 'count="12"', 'count="15"'),
    ("array with letters in it", "geometry", "1 1 0", "1 l 0"),
    ("accessor that reads beyond its array", "geometry", 'count="4"', 'count="400"'),
    ("accessor without stride", "geometry", ' stride="3"', ""),
    ("stride of 0", "geometry", 'stride="3"', 'stride="0"'),
    ("stride of two thousand million", "geometry", 'stride="3"', 'stride="2000000000"'),
    ("negative stride", "geometry", 'stride="3"', 'stride="-3"'),
    ("triangles without count", "geometry", 'triangles count="2"', "triangles"),
    ("triangles that are fewer than they say", "geometry", 'triangles count="2"', 'triangles count="3"'),
    ("p that is too short", "geometry", "<p>0 1 2 0 2 3", "<p>0 1 2 0 2"),
    ("p beyond the vertices", "geometry", "0 2 3<", "0 2 4<"),
    ("p with a negative index", "geometry", "<p>0", "<p>-1"),
    ("triangles without VERTEX", "geometry", 'semantic="VERTEX"', 'semantic="NORMAL"'),
    ("vertices without POSITION", "geometry", 'semantic="POSITION"', 'semantic="TEXCOORD"'),
    ("offset that p does not have", "geometry", 'offset="0"', 'offset="2"'),
    ("input without offset", "geometry", ' offset="0"', ""),
    ("polylist whose vcount counts more", "geometry", '(?s)<triangles count="2"(.*?)<p>(.*)</triangles>',
     r'<polylist count="2"\1<vcount>3 4</vcount><p>\2</polylist>'),
    ("polylist with fewer vcounts", "geometry", '(?s)<triangles count="2"(.*?)<p>(.*)</triangles>',
     r'<polylist count="2"\1<vcount>3</vcount><p>\2</polylist>'),
    ("skin whose v is too short", "skin", "2 1 0</v>", "2 1</v>"),
    ("skin with a weight beyond its source", "skin", "2 1 0</v>", "2 1 9</v>"),
    ("skin with a joint beyond its source", "skin", "2 1 0</v>", "2 7 0</v>"),
    ("skin with fewer vcounts than vertices", "skin", "1 2 1</vcount>", "1 2</vcount>"),
    ("morph with fewer weights than targets", "morph", 'count="1">0.5', 'count="0">'),
    ("keys without their values", "linear_animation", 'count="2">0 1</float_array>\n        <technique_common><accessor '
     'source="#values-array" count="2"', 'count="1">0</float_array>\n        <technique_common><accessor source="#values-array" count="1"'),
    # What has to be there.
    ("skin without JOINT", "skin", '<input semantic="JOINT" source="#joints" offset="0"/>', ""),
    ("skin without WEIGHT", "skin", '<input semantic="WEIGHT" source="#weights" offset="1"/>', ""),
    ("skin without joints", "skin", r"(?s)<joints>.*?</joints>", ""),
    ("skin without INV_BIND_MATRIX", "skin", '<input semantic="INV_BIND_MATRIX" source="#binds"/>', ""),
    ("sampler without INPUT", "linear_animation", '<input semantic="INPUT" source="#times"/>', ""),
    ("sampler without OUTPUT", "linear_animation", '<input semantic="OUTPUT" source="#values"/>', ""),
    ("mesh without vertices", "geometry", r"<vertices .*</vertices>", ""),
    ("light without technique_common", "light", r"(?s)<technique_common>.*</technique_common>", ""),
    ("camera without optics", "camera", r"(?s)<optics>.*</optics>", ""),
    # The document as a whole.
    ("unknown version", "geometry", 'version="1.4.1"', 'version="1.9"'),
    ("no version", "geometry", ' version="1.4.1"', ""),
    ("another root", "geometry", "COLLADA", "COLLADO"),
    ("end tag that fits none", "geometry", "</mesh>", "</mash>"),
    ("cut file", "geometry", r"(?s)<p>.*", "<p>0 1"),
    ("two elements with one id", "geometry", 'id="root"', 'id="quad"'),
    ("node in itself", "geometry", "<instance_geometry", '<instance_node url="#root"/><instance_geometry'),
]
assert len({row[0] for row in WRONG}) == len(WRONG)
# What readers repair without loss, so that it is a warning: at most three of these documents.
MOST_ACCEPTED = 3


class WrongDocuments(ProgramTest):
    def setUp(self):
        super().setUp()
        shutil.copytree(FILES, self.folder / "files")

    def test_the_bases_are_right(self):
        for base in sorted({row[1] for row in WRONG}):
            with self.subTest(base):
                self.expect(run("kinora-validate", self.write(f"{base}.dae", (BASES / f"{base}.dae").read_text())), 0)

    def test_each_is_an_error_by_default(self):
        accepted = []
        for number, (what, base, old, new) in enumerate(WRONG):
            good = (BASES / f"{base}.dae").read_text()
            wrong, changes = re.subn(old, new, good, count=0 if old == "COLLADA" else 1)
            self.assertTrue(changes and wrong != good, what)
            result = run("kinora-validate", self.write(f"{number}.dae", wrong))
            self.assertIn(result.code, (0, 1, 3), f"{what}: {result}")
            said = re.findall(r": (\w+): .* \[(\w+)\]$", result.out + result.err, re.M)
            self.assertTrue(said, f"{what}: nothing is said")
            if result.code == 0:
                accepted.append(f"{what}: {said}")
        self.assertGreaterEqual(len(WRONG), 53)
        self.assertLessEqual(len(accepted), MOST_ACCEPTED, "\n".join(accepted))


if __name__ == "__main__":
    main()
