"""tests/programs/coshaders_test.py: co-shaders of profile_RSL: pictures against one shader written by hand, the library
of a scene, conversions, parameters, and what the validator says, with line and column."""
import json
import re

from programs import main, run, shade
from written_scenes import SceneTest

LAYERED = """class layered(shader base = null; shader layers[] = {}; float gain = 1;) {
    public void surface(output color Ci, Oi) {
        color c = 0;
        float i;
        if (base != null) base->tint(c);
        for (i = 0; i < arraylength(layers); i += 1) layers[i]->cover(c);
        Ci = gain * c;
        Oi = 1;
    }
}
"""
CLAY = "class clay(color tone = color(0.8, 0.4, 0.2);) { public void tint(output color c) { c = tone * s; } }\n"
DIRT = "class dirt(float amount = 0.5;) { public void cover(output color c) { c = mix(c, color 0, amount * t); } }\n"
COAT = "class coat(float gloss = 0.25;) { public void cover(output color c) { c += gloss * s * t; } }\n"
BY_HAND = """surface by_hand(color tone = color(0.8, 0.4, 0.2); float amount = 0.5, gloss = 0.25, gain = 1;) {
    color c = tone * s;
    c = mix(c, color 0, amount * t);
    c += gloss * s * t;
    Ci = gain * c;
    Oi = 1;
}
"""
BINDS = """<bind symbol="base"><string>clay</string></bind>
<bind symbol="layers"><array length="2"><string>dirt</string><string>coat</string></array></bind>
<bind symbol="gain"><param ref="gain"/></bind>"""
CO_SHADERS = """<shader stage="COSHADER" handle="clay"><name>clay</name><bind symbol="tone"><param ref="tone"/></bind></shader>
<shader stage="COSHADER" handle="dirt"><name>dirt</name></shader>
<shader stage="COSHADER" handle="coat"><name>coat</name><bind symbol="gloss"><param ref="gloss"/></bind></shader>"""
NEWPARAMS = """<newparam sid="gain"><float>0.75</float></newparam><newparam sid="tone"><color>0.9 0.5 0.3</color></newparam>
<newparam sid="gloss"><float>0.5</float></newparam><newparam sid="under"><string>clay</string></newparam>"""
HAND_PASS = """<shader stage="SURFACE"><name>by_hand</name><bind symbol="gain"><param ref="gain"/></bind>
<bind symbol="tone"><param ref="tone"/></bind><bind symbol="gloss"><param ref="gloss"/></bind></shader>"""


def effect(code, passes, params="", id="fx"):
    return f"""<effect id="{id}"><profile_RSL>{params}<technique sid="t">
<code><![CDATA[{code}]]></code>
<pass>
{passes}
</pass></technique></profile_RSL></effect>"""


def surface(binds=BINDS):
    return f'<shader stage="SURFACE"><name>layered</name>\n{binds}</shader>'


def document(effects, setparams="", scene_extra="", animation=""):
    """A square that fills the picture, s and t from 0 to 1."""
    return f"""<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><created>2026-01-01T00:00:00Z</created><modified>2026-01-01T00:00:00Z</modified></asset>
{animation}<library_cameras><camera id="c"><optics><technique_common><orthographic><xmag>1</xmag><ymag>1</ymag>
<znear>0.1</znear><zfar>100</zfar></orthographic></technique_common></optics></camera></library_cameras>
<library_effects>
{effects}
</library_effects>
<library_materials><material id="m"><instance_effect url="#fx">{setparams}</instance_effect></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">-1 -1 0 1 -1 0 1 1 0 -1 1 0</float_array><technique_common>
<accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<source id="u"><float_array id="ua" count="8">0 0 1 0 1 1 0 1</float_array><technique_common>
<accessor source="#ua" count="4" stride="2"><param name="S" type="float"/><param name="T" type="float"/></accessor>
</technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles material="skin" count="2"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="TEXCOORD" source="#u" offset="0" set="0"/><p>0 1 2 0 2 3</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="scene">
<node id="eye"><translate>0 0 10</translate><instance_camera url="#c"/></node>
<node id="n"><instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="skin" target="#m"/></technique_common></bind_material></instance_geometry></node>
{scene_extra}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
"""


ALL = LAYERED + CLAY + DIRT + COAT
SCENE = document(effect(ALL, surface() + CO_SHADERS, NEWPARAMS))
HAND = document(effect(BY_HAND, HAND_PASS, NEWPARAMS))
LIBRARY = "<extra><technique profile=\"RSL\"><instance_effect url=\"#lib\"/></technique></extra>\n"


def animated(sid):
    return f"""<library_animations><animation id="a"><source id="at"><float_array id="ata" count="2">0 1</float_array>
<technique_common><accessor source="#ata" count="2" stride="1"><param name="TIME" type="float"/></accessor></technique_common>
</source><source id="av"><float_array id="ava" count="2">0 1</float_array><technique_common>
<accessor source="#ava" count="2" stride="1"><param name="V" type="float"/></accessor></technique_common></source>
<source id="ai"><Name_array id="aia" count="2">LINEAR LINEAR</Name_array><technique_common>
<accessor source="#aia" count="2" stride="1"><param name="INTERPOLATION" type="name"/></accessor></technique_common></source>
<sampler id="as"><input semantic="INPUT" source="#at"/><input semantic="OUTPUT" source="#av"/>
<input semantic="INTERPOLATION" source="#ai"/></sampler><channel source="#as" target="fx/{sid}"/></animation></library_animations>
"""


# s > 0.5 is a hole.
LEAF = """class leaf(shader pattern = null; float size = 0.5;) {
    varying float hole = 0;
    public void displacement(output point P; output normal N) { hole = pattern->cut(size); }
    public void opacity(output color Oi) { Oi = 1 - hole; }
    public void surface(output color Ci, Oi) { printf("surface\\n"); Ci = Oi * color(0, 1, 0); }
}
class cutter() { public float cut(float size) { return step(size, s); } }
"""
# The light shines from the left, at 45 degrees: the leaf at x -3 to -1, 2 above the floor, shades x -1 to 1.
SHADOWED = """<node id="leaf"><translate>-2 0 2</translate><instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="skin" target="#m"/></technique_common></bind_material></instance_geometry></node>
<node id="lamp"><instance_light url="#sun"/></node>
"""
SUN = """<library_lights><light id="sun"><technique_common><directional><color>1 1 1</color></directional></technique_common>
<extra><technique profile="RSL"><instance_effect url="#sun-fx"/></technique></extra></light></library_lights>
"""


class Shadows(SceneTest):
    def scene(self, leaf):
        floor = effect("surface floor() { Ci = 0; illuminance(P, N, PI / 2) Ci += Cl; Oi = 1; }",
                       '<shader stage="SURFACE"/>', id="floor-fx")
        sun = effect('light slanted() { solar(vector "world" (1, 0, -1), 0) Cl = 1; }', '<shader stage="LIGHT"/>',
                     id="sun-fx")
        text = document(leaf + floor + sun, scene_extra=SHADOWED)
        text = text.replace("<library_effects>", SUN + "<library_effects>", 1)
        text = text.replace("</library_materials>", '<material id="floor"><instance_effect url="#floor-fx"/></material>'
                            "</library_materials>")
        return text.replace('<node id="n">', '<node id="n">', 1).replace('target="#m"', 'target="#floor"', 1)

    def test_opacity_reads_what_displacement_wrote(self):
        leaf = effect(LEAF, """<shader stage="SURFACE"><name>leaf</name><bind symbol="pattern"><string>cutter</string></bind>
</shader><shader stage="COSHADER" handle="cutter"><name>cutter</name></shader>""")
        text = self.scene(leaf)
        said = self.render(text)
        # The camera does not see the leaf: all its points are those of shadow rays, which run no surface().
        self.assertNotIn("surface", (said.out + said.err).split())
        left, right = self.pixel(x=8), self.pixel(x=24)
        self.assertEqual((left, right), ((0, 0, 0), (255, 255, 255)))
        self.render(text, "--param", "m.size=2")
        self.assertEqual((self.pixel(x=8), self.pixel(x=24)), ((0, 0, 0), (0, 0, 0)))

    def test_explain_tells_the_kernel_of_shadow_rays(self):
        leaf = effect(LEAF, """<shader stage="SURFACE"><name>leaf</name><bind symbol="pattern"><string>cutter</string></bind>
</shader><shader stage="COSHADER" handle="cutter"><name>cutter</name></shader>""")
        rows = self.expect(run("kinora-render", self.write("scene.dae", self.scene(leaf)), "--explain", "text"), 0).out
        self.assertIn("asks for print", rows)
        found = re.search(r"a kernel of its own for shadow rays; .*: (\d+) of (\d+) bytes of code, no calls that remain", rows)
        self.assertTrue(found, rows)
        self.assertLess(int(found[1]), int(found[2]) / 2)


# A square that rises along s, and shows how high.
RAISED = """class raised(float gain = 0.5; string mode = "all";) {
    varying float height = 0; varying float before = 0;
    public void begin() { before = zcomp(transform("object", P)); }
    public void displacement(output point P; output normal N) {
        height = gain * s;
        P += height * normalize(N);
        N = calculatenormal(P);
    }
    public void surface(output color Ci, Oi) {
        Oi = 1;
        Ci = color(height, abs(before) < 0.0001 ? 0.5 : 0, abs(zcomp(ntransform("object", normalize(N)))));
    }
}
"""
APART = """displacement lift(float gain = 0.5; output varying float height = 0;) {
    height = gain * s;
    P += height * normalize(N);
    N = calculatenormal(P);
}
surface seen() {
    float height = 0;
    displacement("height", height);
    Oi = 1;
    Ci = color(height, 0.5, abs(zcomp(ntransform("object", normalize(N)))));
}
"""
NONE_MOVES = "displacement none(float gain = 9;) { P += vector(0, 0, gain); }\n"


class Displaced(SceneTest):
    """The square is seen by a slanted camera, so that its height shows."""

    def seen(self, code, passes, out, *words):
        text = document(effect(code, passes)).replace("<translate>0 0 10</translate>",
                                                      "<rotate>0 1 0 50</rotate><translate>0 0 10</translate>", 1)
        self.render(text, "--dice", "8", *words, out=out, name=out + ".dae")
        return self.bytes_of(out)

    def test_a_class_moves_its_vertices_as_a_displacement_does(self):
        apart = '<shader stage="DISPLACEMENT"/><shader stage="SURFACE"/>'
        for words in ((), ("--displacement", "bump")):
            one = self.seen(RAISED, '<shader stage="SURFACE"/>', "one.png", *words)
            two = self.seen(APART, apart, "two.png", *words)
            self.assertEqual(one, two, words)
        self.seen(RAISED.replace("P += height", "point q = P + height"), '<shader stage="SURFACE"/>', "flat.png")
        self.seen(RAISED, '<shader stage="SURFACE"/>', "one.png")
        self.assertNotEqual(self.box("one.png"), self.box("flat.png"))

    def test_its_own_goes_before_another_displacement(self):
        both = '<shader stage="DISPLACEMENT"><name>none</name></shader><shader stage="SURFACE"/>'
        self.assertEqual(self.seen(RAISED + NONE_MOVES, both, "both.png"),
                         self.seen(RAISED, '<shader stage="SURFACE"/>', "one.png"))

    def test_a_class_bound_as_a_displacement_only_displaces(self):
        plain = "surface plain() { Ci = color(0.25, s, t); Oi = 1; }\n"
        stages = '<shader stage="DISPLACEMENT"><name>{}</name></shader><shader stage="SURFACE"><name>plain</name></shader>'
        self.assertEqual(self.seen(RAISED + plain, stages.format("raised"), "class.png"),
                         self.seen(APART + plain, stages.format("lift"), "apart.png"))


class OpenArrays(SceneTest):
    """A parameter "T a[]" is as long as what the effect binds."""
    CODE = """class list(float a[] = {9}; string words[] = {}; color tints[] = 0;) {
        public void surface(output color Ci, Oi) {
            float i, sum = 0;
            for (i = 0; i < arraylength(a); i += 1) sum += a[i];
            Ci = color(sum, arraylength(words) / 4, arraylength(tints) / 4); Oi = 1;
            if (arraylength(words) > 1 && words[1] == "two") Ci += color(0, 0.25, 0);
        }
    }"""
    BINDS = """<shader stage="SURFACE"><bind symbol="a"><array length="3"><float>0.125</float><float>0.25</float>
<float>0.125</float></array></bind><bind symbol="words"><array length="2"><string>one</string><string>two</string></array></bind>
<bind symbol="tints"><array length="1"><color>1 0 0</color></array></bind></shader>"""

    def test_bound_lengths(self):
        for passes, hand in ((self.BINDS, "color(0.5, 0.75, 0.25)"), ('<shader stage="SURFACE"/>', "color(9, 0, 0)")):
            text = document(effect(self.CODE, passes))
            self.render(text, out="a.png", name="a.dae")
            self.render(document(effect("surface x() { Ci = %s; Oi = 1; }" % hand, '<shader stage="SURFACE"/>')),
                        out="b.png", name="b.dae")
            self.assertEqual(self.bytes_of("a.png"), self.bytes_of("b.png"))
            for to in ("a.glb", "again.dae"):
                self.expect(run("kinora-convert", self.folder / "a.dae", self.folder / to), 0)
                self.expect(run("kinora-render", self.folder / to, "-o", self.folder / "c.png", "--size", "32x32",
                                "--spp", "4", "--filter", "box", "--color", "legacy", "--progress", "none"), 0)
                self.assertEqual(self.bytes_of("c.png"), self.bytes_of("a.png"), to)


class CoShaders(SceneTest):
    def same_picture(self, text, other, words=(), other_words=()):
        self.render(text, *words, out="a.png", name="a.dae")
        self.render(other, *other_words, out="b.png", name="b.dae")
        self.assertEqual(self.bytes_of("a.png"), self.bytes_of("b.png"))
        self.assertGreater(len({self.pixel("a.png", x, 9) for x in range(0, 32, 4)}), 4)

    def validate(self, text, expected):
        """Codes with their lines and columns, exactly; the texts that they point at are looked for in the document."""
        path = self.write("wrong.dae", text)
        report = json.loads(run("kinora-validate", "--format", "json", path).out)
        found = sorted((f["code"], f["line"], f["column"]) for file in report["files"] for f in file["findings"]
                       if f["code"].startswith("RSL_"))
        places = []
        for code, marker, skip in expected:
            at = text.index(marker) + skip
            places.append((code, text.count("\n", 0, at) + 1, at - text.rfind("\n", 0, at)))
        self.assertEqual(found, sorted(places), report)

    def test_pictures_are_those_of_one_shader(self):
        self.same_picture(SCENE, HAND)
        self.same_picture(SCENE, HAND, ["--param", "m.coat.gloss=0.9"], ["--param", "m.gloss=0.9"])
        self.same_picture(SCENE, HAND, ["--param", "dirt.amount=0.1"], ["--param", "m.amount=0.1"])

    def test_parameters_are_animated(self):
        self.same_picture(SCENE.replace("<library_cameras>", animated("gloss") + "<library_cameras>", 1),
                          HAND.replace("<library_cameras>", animated("gloss") + "<library_cameras>", 1),
                          ["--time", "0.25"], ["--time", "0.25"])

    def test_vertices_give_their_parameters_values(self):
        """The texture coordinate as the vertices' "wear", which a co-shader and the surface itself take."""
        bound = ('target="#m"/>', 'target="#m"><bind_vertex_input semantic="wear" input_semantic="TEXCOORD" input_set="0"/>'
                 "</instance_material>")
        worn = document(effect(LAYERED + CLAY.replace("= color(0.8, 0.4, 0.2);", "= color(0.8, 0.4, 0.2); varying float wear = 0;")
                               .replace("tone * s", "tone * wear"), surface(BINDS.split("\n")[0])
                               + CO_SHADERS.split("\n")[0], NEWPARAMS))
        hand = effect("surface x(varying float wear = 0;) { Ci = color(0.9, 0.5, 0.3) * wear; Oi = 1; }",
                      '<shader stage="SURFACE"/>')
        self.same_picture(worn.replace(*bound), document(hand).replace(*bound))

    def test_a_library_is_of_the_scene(self):
        library = effect(CLAY + DIRT + COAT, CO_SHADERS, NEWPARAMS, "lib")
        text = document(effect(LAYERED, surface(), NEWPARAMS) + library, scene_extra=LIBRARY)
        self.same_picture(text, HAND)
        self.validate(text, self.unused(text))

    def unused(self, text):
        """The parameters that each half of the shared list does not bind."""
        first, second = text.index(NEWPARAMS), text.rindex(NEWPARAMS)
        places = []
        for start, sids in ((first, ("tone", "gloss", "under")), (second, ("gain", "under"))):
            for sid in sids:
                marker = f'<newparam sid="{sid}"'
                places.append(("RSL_PARAM_UNUSED", text[start:], text[start:].index(marker)))
        return places

    def test_the_pass_hides_the_library(self):
        library = effect(CLAY.replace("tone * s", "color(0, 0, 1)") + DIRT, """<shader stage="COSHADER" handle="clay">
<name>clay</name></shader><shader stage="COSHADER" handle="dirt"><name>dirt</name></shader>""", id="lib")
        own = "\n".join(line for line in CO_SHADERS.split("\n") if "dirt" not in line)
        self.same_picture(document(effect(LAYERED + CLAY + COAT, surface() + own, NEWPARAMS) + library,
                                   scene_extra=LIBRARY), HAND)

    def test_a_material_binds_another_handle(self):
        code = ALL + "class rust() { public void tint(output color c) { c = color(0, t, s); } }\n"
        binds = BINDS.replace("<string>clay</string>", '<param ref="under"/>')
        passes = surface(binds) + CO_SHADERS + '<shader stage="COSHADER" handle="rust"><name>rust</name></shader>'
        hand = HAND.replace("color c = tone * s;", "color c = color(0, t, s);")
        self.same_picture(document(effect(code, passes, NEWPARAMS)), HAND)
        self.same_picture(document(effect(code, passes, NEWPARAMS),
                                   '<setparam ref="under"><string>rust</string></setparam>'), hand)

    def test_conversions_keep_them(self):
        library = effect(CLAY + DIRT, CO_SHADERS[:CO_SHADERS.rindex("\n")], NEWPARAMS, "lib")
        own = CO_SHADERS[CO_SHADERS.rindex("\n"):]
        shared = document(effect(LAYERED + COAT, surface() + own, NEWPARAMS) + library, scene_extra=LIBRARY)
        for text in (SCENE, shared):
            self.render(text, out="first.png", name="first.dae")
            for source, to in (("first.dae", "first.glb"), ("first.glb", "second.dae"), ("first.dae", "third.dae")):
                self.expect(run("kinora-convert", self.folder / source, self.folder / to), 0)
            for name in ("first.glb", "second.dae", "third.dae"):
                again = (self.folder / name).read_bytes()
                if name.endswith(".dae"):
                    self.assertEqual(again.count(b'stage="COSHADER"'), 3)
                    self.assertIn(b"class layered", again)
                    self.assertIn(b"class dirt", again)
                self.expect(run("kinora-render", self.folder / name, "-o", self.folder / "again.png", "--size", "32x32",
                                "--spp", "4", "--filter", "box", "--color", "legacy", "--progress", "none"), 0)
                self.assertEqual(self.bytes_of("again.png"), self.bytes_of("first.png"), name)
            self.expect(run("kinora-render", self.folder / "second.dae", "-o", self.folder / "c.png", "--size", "32x32",
                            "--param", "coat.gloss=0", "--progress", "none"), 0)

    def test_programs_know_their_parameters(self):
        path = self.write("scene.dae", SCENE)
        self.expect(shade("info", path), 0, "coat.gloss", "clay.tone", 'effect binds base = "clay"',
                    "effect binds coat.gloss = 0.5", 'co-shader "dirt"')
        self.assertEqual(shade("info", path).out.count("effect binds coat.gloss"), 1)
        self.expect(run("kinora-render", path, "--list", "params"), 0, "coat.gloss", "dirt.amount")
        schema = run("kinora-validate", "--print-schema", "1.4.1").out
        self.assertIn("COSHADER", schema)
        self.assertIn('name="handle"', schema)

    def test_what_is_right_is_silent(self):
        self.validate(SCENE, [("RSL_PARAM_UNUSED", '<newparam sid="under"', 0)])

    def test_wrong_handles(self):
        unused = ("RSL_PARAM_UNUSED", '<newparam sid="under"', 0)
        self.validate(SCENE.replace("<string>coat</string>", "<string>coot</string>"),
                      [unused, ("RSL_HANDLE_UNBOUND", '<bind symbol="layers"', 0),
                       ("RSL_COSHADER_UNUSED", 'handle="coat"', 8)])
        self.validate(SCENE.replace('"COSHADER" handle="dirt"', '"COSHADER" handle="clay"'),
                      [unused, ("RSL_SHADER_UNUSED", '<technique sid="t"', 0), ("RSL_HANDLE_TWICE", 'handle="clay"><name>dirt', 8),
                       ("RSL_HANDLE_UNBOUND", '<bind symbol="layers"', 0)])
        self.validate(SCENE.replace('"COSHADER" handle="dirt"', '"COSHADER"'),
                      [unused, ("RSL_SHADER_UNUSED", '<technique sid="t"', 0), ("RSL_HANDLE_MISSING", 'COSHADER"><name>dirt', 0),
                       ("RSL_HANDLE_UNBOUND", '<bind symbol="layers"', 0)])
        self.validate(SCENE.replace("<string>clay</string>", "<float>1</float>"),
                      [unused, ("RSL_BIND_TYPE", '<bind symbol="base"', 0),
                       ("RSL_COSHADER_UNUSED", 'handle="clay"', 8)])

    def test_wrong_code(self):
        unused = ("RSL_PARAM_UNUSED", '<newparam sid="under"', 0)
        code = ALL.replace("color c = 0;", 'color c = 0; shader x[] = getshaders("category", "moss");')
        self.validate(document(effect(code, surface() + CO_SHADERS, NEWPARAMS)),
                      [unused, ("RSL_CATEGORY_EMPTY", "getshaders(", 0)])
        code = ALL.replace("color c = 0;", 'color c = 0; shader x = getshader("moss");')
        self.validate(document(effect(code, surface() + CO_SHADERS, NEWPARAMS)),
                      [unused, ("RSL_GETSHADER_NULL", "getshader(", 0)])
        code = ALL.replace("c += gloss * s * t;", 'shader d = getshader("dirt"); d->cover(c);').replace(
            "c = mix(c, color 0, amount * t);", 'shader d = getshader("coat"); d->cover(c);')
        text = document(effect(code, surface() + CO_SHADERS, NEWPARAMS))
        result = run("kinora-validate", self.write("circle.dae", text))
        self.assertIn("RSL_CO_SHADER_CYCLE", result.out + result.err)
        self.assertIn("dirt->cover()", result.out + result.err)


if __name__ == "__main__":
    main()
