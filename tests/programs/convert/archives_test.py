"""tests/programs/convert/archives_test.py: shaders, and the files that they name, inside archives and in folders of their own."""
import sys
import zipfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import SOURCE, ProgramTest, main, render, run

sys.path[:0] = [str(SOURCE / "tests/conformance"), str(SOURCE / "scripts")]
import dae  # noqa: E402
from sheet import png  # noqa: E402

SMALL = ("--size", "16x16", "--spp", "1", "--progress", "none")
EFFECT = ('<effect id="fx"><profile_RSL><technique sid="t">{parts}<pass><shader stage="SURFACE"/></pass>'
          "</technique></profile_RSL></effect>")
TEXTURED = 'surface s() {{ Oi = 1; Ci = color texture("{}"); }}'
ROOT = "<dae_root>m/scene.dae</dae_root>"
MAP = dae.png(dae.picture())


def code(text):
    return f"<code><![CDATA[{text}]]></code>"


def scene(*parts):
    return dae.plain(effects=EFFECT.format(parts="".join(parts)))


class Archives(ProgramTest):
    def archive(self, name, members):
        path = self.folder / name
        with zipfile.ZipFile(path, "w") as packed:
            for member, content in members.items():
                packed.writestr(member, content)
        return path

    def picture(self, path):
        out = self.folder / "picture.png"
        result = self.expect(render(path, "-o", out, *SMALL), 0)
        self.assertNotIn("warning", result.err, path)
        rows = png.read(out)[2]
        self.assertGreater(sum(map(sum, rows)), 0)
        return rows

    def everywhere(self, archive, kinds=("dae", "glb", "gltf")):
        """The picture of the archive, and the same of what it becomes; the archive is gone by then."""
        shown = self.picture(archive)
        self.expect(run("kinora-validate", archive), 0)
        made = [self.folder / f"out/{archive.stem}.{kind}" for kind in kinds]
        for path in made:
            self.expect(run("kinora-convert", archive, path), 0)
        archive.unlink()
        for path in made:
            self.assertEqual(self.picture(path), shown, path)
        return shown

    def test_all_models_of_a_kmz_are_shown_and_converted(self):
        """Two models beside each other, the second one twice as high: a document that holds both looks the same."""
        first, second = (f'<node id="{id}"><translate>{x} 0 0</translate>{{}}{dae.shown()}</node>'
                         for id, x in (("n", -.5), ("m", .5)))
        whole = dae.document(first.format("") + second.format("<scale>1 2 1</scale>"))
        link = "<Model>{}<Link><href>{}</href></Link></Model>"
        archive = self.archive("two.kmz", {
            "doc.kml": "<kml>" + link.format("", "a.dae") + link.format("<Scale><z>2</z></Scale>", "b.dae") + "</kml>",
            "a.dae": dae.document(first.format("")),
            "b.dae": dae.document(second.format(""), lights="", light_nodes="", cameras="", eye="")})
        shown = self.everywhere(archive)
        scene = self.write("whole.dae", whole)
        self.assertEqual(self.picture(scene), shown)

    def test_names_in_code_are_found_in_an_archive(self):
        """From the document's folder, which need not be the top, and from the top."""
        wanted = self.everywhere(self.archive("deep.zae", {
            "manifest.xml": ROOT, "m/scene.dae": scene(code(TEXTURED.format("tex/map.png"))), "m/tex/map.png": MAP}))
        top = self.everywhere(self.archive("top.ZAE", {
            "manifest.xml": ROOT, "m/scene.dae": scene(code(TEXTURED.format("tex/map.png"))), "tex/map.png": MAP}))
        self.assertEqual(top, wanted)
        self.assertTrue((self.folder / "out/deep_files/m/tex/map.png").is_file())

    def test_shaders_in_files_of_an_archive(self):
        members = {"manifest.xml": ROOT, "m/sh/own.h": "#define OWN 0.5\n", "m/tex/map.png": MAP}
        include = '<include sid="i" url="sh/s.sl"/>'
        textured = '#include "own.h"\n' + TEXTURED.format("tex/map.png")
        for name, shader, kinds in (("grey", '#include "own.h"\nsurface s() { Oi = 1; Ci = OWN; }', ("dae", "glb", "gltf")),
                                    ("map", textured, ("glb", "gltf"))):  # the file of a .dae's <include> stays as it is
            pictures = []
            for order, parts in (("only", (include,)), ("first", (include, code("/* own */"))), ("last", (code("/* own */"), include))):
                pictures.append(self.everywhere(self.archive(
                    f"{name}_{order}.zae", members | {"m/sh/s.sl": shader, "m/scene.dae": scene(*parts)}), kinds))
            self.assertEqual(pictures[1:], pictures[:-1])

    def test_code_may_stand_behind_and_before_an_include(self):
        """The document is named by a path of another folder; the shader uses what the include defines, or the other way round."""
        self.write("m/sh/half.sl", "float half() { return 0.5; }\n")
        include, shader = '<include sid="i" url="sh/half.sl"/>', code("surface s() { Oi = 1; Ci = half(); }")
        wanted = self.picture(self.write("m/plain.dae", scene(code("surface s() { Oi = 1; Ci = 0.5; }"))))
        self.assertEqual(self.picture(self.write("m/first.dae", scene(include, shader))), wanted)
        self.write("m/sh/s.sl", "surface s() { Oi = 1; Ci = half(); }\n")
        self.assertEqual(self.picture(self.write("m/last.dae", scene(
            code("float half() { return 0.5; }"), '<include sid="i" url="sh/s.sl"/>'))), wanted)
        out = self.folder / "picture.png"
        self.expect(render("m/first.dae", "-o", out, *SMALL, cwd=self.folder), 0)
        self.expect(render("first.dae", "-o", out, *SMALL, cwd=self.folder / "m"), 0)
        broken = self.write("m/broken.dae", scene(include, "\n", code("surface s() { Ci = third(); }")))
        self.expect(render(broken, "-o", out, *SMALL), 4, "broken.dae:", "unknown function 'third'")


if __name__ == "__main__":
    main()
