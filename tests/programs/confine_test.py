"""tests/programs/confine_test.py: what a scene asks for is read and written in its own folder only; its
pictures are read wherever they lie, unless --confine keeps them in too. Only regular files are opened."""
import json
import os
import stat
import sys
import zipfile

from programs import SOURCE, ProgramTest, main, render, run, shade

sys.path[:0] = [str(SOURCE / "tests/conformance")]
import dae  # noqa: E402

SMALL = ("--size", "8x8", "--spp", "1", "--threads", "1", "--time", "0")
RSL = """<effect id="fx"><profile_RSL>{params}<technique sid="t"><code><![CDATA[{code}]]></code>
<pass><shader stage="SURFACE">{binds}</shader></pass></technique></profile_RSL></effect>"""
GREEN = "surface s() {{ Oi = 1; Ci = {} ; }}"


class ConfineTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("secret/green.h", "#define GREEN color(0, 1, 0)\n")
        self.write("secret/s.sl", GREEN.format("color(0, 1, 0)"))
        self.write_bytes("secret/map.png", dae.png(dae.picture()))
        self.write("scene/own.h", "#define GREEN color(0, 1, 0)\n")
        self.write_bytes("scene/map.png", dae.png(dae.picture()))

    def write_bytes(self, name, data):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
        return path

    def scene(self, code, name="scene/main.dae", params="", binds="", images=""):
        effect = RSL.format(code=code, params=params, binds=binds)
        return self.write(name, dae.plain(effects=effect, images=images))

    def picture(self, scene, *words, code=0, **options):
        out = self.folder / "picture.png"
        out.unlink(missing_ok=True)
        result = render(scene, "-o", out, *SMALL, *words, **options)
        self.assertEqual(result.code, code, result)
        data = out.read_bytes() if out.exists() else b""
        return data[data.index(b"IDAT"):] if data else b"", result.err

    def codes(self, scene, *words):
        report = json.loads(run("kinora-validate", "--format", "json", *words, scene).out)
        return [(f["code"], f["line"]) for f in report["files"][0]["findings"]]

    def line_of(self, scene, text):
        return next(i for i, row in enumerate(scene.read_text().split("\n"), 1) if text in row)


class Includes(ConfineTest):
    def attacks(self):
        os.symlink(self.folder / "secret/green.h", self.folder / "scene/link.h")
        os.symlink(self.folder / "secret", self.folder / "scene/linked")
        return ("../secret/green.h", str(self.folder / "secret/green.h"), "link.h", "linked/green.h",
                "sub/../../secret/green.h", "..\\\\secret\\\\green.h".replace("\\\\", "\\"))

    def test_embedded_code_includes_from_the_scene_s_folder_only(self):
        (self.folder / "scene/sub").mkdir()
        own, said = self.picture(self.scene('#include "own.h"\n' + GREEN.format("GREEN")))
        self.assertNotIn("RSL_", said)
        for name in self.attacks():
            scene = self.scene(f'#include "{name}"\n' + GREEN.format("GREEN"))
            refused, said = self.picture(scene, code=4)
            self.assertIn("RSL_INCLUDE_OUTSIDE", said, name)
            self.assertIn("--allow-external", said)
            self.assertNotEqual(refused, own)
            line = self.line_of(scene, "#include")
            self.assertIn(("RSL_INCLUDE_OUTSIDE", line), self.codes(scene))
            for option in ("--allow-external", "-I"):
                allowed, said = self.picture(scene, option, self.folder / "secret")
                self.assertEqual(allowed, own, said)
                codes = self.codes(scene, option, self.folder / "secret")
                self.assertNotIn("RSL_INCLUDE_OUTSIDE", [code for code, _ in codes])

    def test_an_include_of_an_include_is_held_to_it_too(self):
        self.write("scene/first.h", '#include "../secret/green.h"\n')
        scene = self.scene('#include "first.h"\n' + GREEN.format("GREEN"))
        _, said = self.picture(scene, code=4)
        self.assertIn("first.h:1:10", said)
        self.assertIn("RSL_INCLUDE_OUTSIDE", said)

    def test_customary_headers_and_folders_given_by_I_are_there(self):
        self.write("headers/green.h", "#define GREEN color(0, 1, 0)\n")
        scene = self.scene('#include "noises.h"\n#include <green.h>\n' + GREEN.format("GREEN"))
        own, _ = self.picture(self.scene(GREEN.format("color(0, 1, 0)"), "scene/plain.dae"))
        self.assertEqual(self.picture(scene, "-I", self.folder / "headers")[0], own)

    def test_a_shader_of_the_command_line_reads_beside_itself(self):
        self.write("mine/up.h", "#define GREEN color(0, 1, 0)\n")
        mine = self.write("mine/deep/s.sl", '#include "../up.h"\n' + GREEN.format("GREEN"))
        self.expect(shade("check", mine), 0)
        plain = self.scene(GREEN.format("color(1, 0, 0)"))
        own, _ = self.picture(self.scene(GREEN.format("color(0, 1, 0)"), "scene/green.dae"))
        self.assertEqual(self.picture(plain, "--shader", f"mat={mine}")[0], own)

    def test_kinora_shade_holds_a_scene_s_effect_to_its_folder(self):
        scene = self.scene('#include "../secret/green.h"\n' + GREEN.format("GREEN"))
        self.expect(shade("check", f"{scene}#fx"), 4, "RSL_INCLUDE_OUTSIDE")
        self.expect(shade("check", f"{scene}#fx", "-I", self.folder / "secret"), 0)
        self.expect(shade("check", f"{scene}#fx", "--allow-external", self.folder / "secret"), 0)


class Maps(ConfineTest):
    TEXTURED = 'surface s({}) {{ Oi = 1; Ci = texture({}, 0.3, 0.6); }}'

    CONFINE = "--confine"

    def test_literals_are_held_to_the_folder_at_their_place(self):
        self.write_bytes("scene/none/x", b"")
        checks, _ = self.picture(self.scene(self.TEXTURED.format("", '"none.png"')))
        own, said = self.picture(self.scene(self.TEXTURED.format("", '"map.png"')), self.CONFINE)
        self.assertNotEqual(own, checks)
        self.assertNotIn("warning", said)
        os.symlink(self.folder / "secret/map.png", self.folder / "scene/link.png")
        for name in ("../secret/map.png", str(self.folder / "secret/map.png"), "link.png",
                     "none/../../secret/map.png"):
            scene = self.scene(self.TEXTURED.format("", f'"{name}"'))
            anywhere, said = self.picture(scene)
            self.assertEqual(anywhere, own, said)
            self.assertNotIn("OUTSIDE", said)
            self.assertNotIn("RSL_FILE_OUTSIDE", str(self.codes(scene)))
            refused, said = self.picture(scene, self.CONFINE)
            self.assertEqual(refused, checks, name)
            self.assertIn("RSL_FILE_OUTSIDE", said)
            self.assertIn("--allow-external", said)
            line = self.line_of(scene, "texture(")
            self.assertIn(("RSL_FILE_OUTSIDE", line), self.codes(scene, self.CONFINE))
            allowed, said = self.picture(scene, self.CONFINE, "--allow-external", self.folder / "secret")
            self.assertEqual(allowed, own, said)

    def test_names_that_are_computed_are_too(self):
        name = 'concat("../secr", "et/map.png")'
        scene = self.scene(self.TEXTURED.format("", name))
        checks, _ = self.picture(self.scene(self.TEXTURED.format("", '"none.png"'), "scene/none.dae"))
        self.assertNotEqual(self.picture(scene)[0], checks)
        refused, said = self.picture(scene, self.CONFINE)
        self.assertEqual(refused, checks)
        self.assertIn("lies outside the scene's folder", said)

    def test_parameters_are_too(self):
        code = self.TEXTURED.format('string map = ""', "map")
        own, _ = self.picture(self.scene(code, binds='<bind symbol="map"><string>map.png</string></bind>'))
        checks, _ = self.picture(self.scene(code, binds='<bind symbol="map"><string>no.png</string></bind>'))
        self.assertNotEqual(own, checks)
        for name in ("../secret/map.png", str(self.folder / "secret/map.png")):
            scene = self.scene(code, binds=f'\n<bind symbol="map"><string>{name}</string></bind>')
            self.assertEqual(self.picture(scene)[0], own)
            refused, said = self.picture(scene, self.CONFINE)
            self.assertEqual(refused, checks)
            self.assertIn("lies outside the scene's folder", said)
            if name.startswith("/"):
                self.assertIn(("RSL_FILE_OUTSIDE", self.line_of(scene, "<bind")), self.codes(scene, self.CONFINE))

    def test_pictures_that_the_user_names_are_always_read(self):
        self.write_bytes("mine/other.png", dae.png(dae.picture()))
        scene = self.scene(self.TEXTURED.format('string map = "map.png"', "map"))
        own, _ = self.picture(scene)
        checks, _ = self.picture(scene, "--param", "mat.map=none.png")
        self.assertNotEqual(own, checks)
        for name in (self.folder / "mine/other.png", "mine/other.png"):
            named, said = self.picture(scene, self.CONFINE, "--param", f"mat.map={name}", cwd=self.folder)
            self.assertEqual(named, own, said)

    def test_an_image_that_is_refused_is_not_read_by_its_name(self):
        images = '<image id="im"><init_from>{}</init_from></image>'
        code = self.TEXTURED.format('string map = ""', "map")
        params = '<newparam sid="p"><string>im</string></newparam>'
        bind = '<bind symbol="map"><param ref="p"/></bind>'
        secret = self.folder / "secret/map.png"
        self.write_bytes("secret/other.png", secret.read_bytes())
        secret = self.folder / "secret/other.png"
        checks, _ = self.picture(self.scene(code, binds='<bind symbol="map"><string>no.png</string></bind>'))
        own, _ = self.picture(self.scene(code, binds='<bind symbol="map"><string>map.png</string></bind>'))
        for uri in (f"file://{secret}", f"FILE://{secret}", f"File:{secret}", str(secret), "../secret/other.png",
                    "%2e%2e/secret/other.png", "..%2Fsecret%2Fother.png", "..\\secret\\other.png"):
            scene = self.scene(code, params=params, binds=bind, images=images.format(uri))
            anywhere, said = self.picture(scene)
            self.assertEqual(anywhere, own, (uri, said))
            self.assertNotIn("LINK_OUTSIDE", said, uri)
            refused, said = self.picture(scene, self.CONFINE)
            self.assertEqual(refused, checks, uri)
            self.assertIn("LINK_OUTSIDE", said, uri)
            self.assertIn("LINK_OUTSIDE", str(self.codes(scene, self.CONFINE)))
            allowed, said = self.picture(scene, self.CONFINE, "--allow-external", self.folder / "secret")
            self.assertNotEqual(allowed, checks, (uri, said))
        for uri in ("http://127.0.0.1:9/map.png", "HTTPS://127.0.0.1:9/other.png", "data:image/png;base64,AAAA"):
            scene = self.scene(code, params=params, binds=bind, images=images.format(uri.replace("map", "nomap")))
            self.assertIn("FILE_MISSING", self.picture(scene)[1])

    def test_a_glb_of_a_confined_scene_holds_nothing_from_outside(self):
        scene = self.scene(self.TEXTURED.format('string map = ""', "map"),
                           binds=f'<bind symbol="map"><string>{self.folder}/secret/map.png</string></bind>')
        out = self.folder / "out.glb"
        picture = (self.folder / "secret/map.png").read_bytes()[-60:]
        self.expect(run("kinora-convert", self.CONFINE, scene, out), 0)
        self.assertFalse(picture in out.read_bytes())
        self.expect(run("kinora-convert", scene, out), 0)
        self.assertTrue(picture in out.read_bytes())

    def test_relative_names_are_the_scene_s_wherever_one_stands(self):
        scene = self.scene(self.TEXTURED.format("", '"map.png"'))
        here, _ = self.picture(scene)
        there, _ = self.picture(scene, cwd=self.folder / "secret")
        self.assertEqual(here, there)


class Pictures(ConfineTest):
    """Where <image> finds its file: the layouts that exporters and packages have."""
    URIS = (  # as written; where the file lies, from the folder of all
        ("map.png", "models/meshes/map.png"),
        ("../materials/textures/map.png", "models/materials/textures/map.png"),
        ("map.png", "models/meshes/textures/map.png"),
        ("map.png", "models/meshes/images/map.png"),
        ("map.png", "models/textures/map.png"),
        ("map.png", "models/materials/textures/map.png"),
        ("file:///C:/Users/me/art/map.png", "models/materials/textures/map.png"),
        ("C:\\art\\MAP.PNG", "models/meshes/textures/map.png"),
        ("/nowhere/at/all/map.tga", "models/textures/map.png"),
        ("../../far/away/map.png", "far/away/map.png"),
        ("skins/map.png", "models/meshes/Skins/Map.png"),
        ("../art/stone/map.png", "models/Art/Stone/map.png"),
    )

    def with_image(self, name, uri):
        return self.write(name, dae.textured(path=uri))

    def test_an_image_is_found_where_exporters_leave_it(self):
        data = dae.png(dae.picture())
        for number, (uri, file) in enumerate(self.URIS):
            with self.subTest(uri=uri, file=file):
                root = f"case{number}"
                scene = self.with_image(f"{root}/models/meshes/main.dae", uri)
                missing, said = self.picture(scene)
                self.assertIn("FILE_MISSING", said)
                path = self.write_bytes(f"{root}/{file}", data)
                found, said = self.picture(scene)
                self.assertNotIn("FILE_MISSING", said)
                self.assertNotEqual(found, missing)
                plain = self.with_image(f"{root}/plain/main.dae", f"../{file}")
                self.assertEqual(found, self.picture(plain)[0])
                # From another folder, and by a path that is not absolute.
                there, _ = self.picture(scene.name, cwd=scene.parent)
                self.assertEqual(there, found)
                out = self.folder / f"{root}.glb"
                self.expect(run("kinora-convert", scene, out), 0)
                self.assertTrue(data[-60:] in out.read_bytes())
                if not file.startswith("models/meshes/"):
                    self.assertEqual(self.picture(scene, "--confine")[0], missing)
                path.unlink()

    def test_what_lies_nearer_wins_and_a_name_wins_over_a_stem(self):
        red = dae.png(dae.picture())
        grey = dae.png([[(128, 128, 128)] * 4] * 4)
        scene = self.with_image("models/meshes/main.dae", "/art/map.tga")
        self.write_bytes("models/textures/map.png", red)
        far, _ = self.picture(scene)
        self.write_bytes("models/meshes/map.png", grey)
        near, _ = self.picture(scene)
        self.assertNotEqual(near, far)
        os.rename(self.folder / "models/textures/map.png", self.folder / "models/textures/map.tga")
        self.assertEqual(self.picture(scene)[0], far)  # a PNG, whatever its name

    def test_gltf_finds_them_too(self):
        out = self.folder / "scene/out.gltf"
        scene = self.with_image("scene/textured.dae", "map.png")
        self.expect(run("kinora-convert", scene, out), 0)
        tree = json.loads(out.read_text())
        tree["images"] = [{"uri": "textures/Gone.png"}]
        out.write_text(json.dumps(tree))
        missing, said = self.picture(out)
        self.assertIn("IMAGE_UNREADABLE", said)
        os.makedirs(self.folder / "materials/textures")
        self.write_bytes("materials/textures/gone.png", dae.png(dae.picture()))
        found, said = self.picture(out)
        self.assertNotEqual(found, missing)
        self.assertNotIn("IMAGE_UNREADABLE", said)
        os.rename(self.folder / "secret/map.png", self.folder / "secret/other.png")
        tree["images"] = [{"uri": "../secret/other.png"}]
        out.write_text(json.dumps(tree))
        self.assertEqual(self.picture(out)[0], found)
        self.assertIn("GLTF_FILE", self.picture(out, "--confine")[1])

    def test_a_repair_writes_where_the_image_is(self):
        scene = self.with_image("models/meshes/main.dae", "C:/art/map.png")
        self.write_bytes("models/materials/textures/map.png", dae.png(dae.picture()))
        run("kinora-validate", "--fix", "--in-place", scene)
        self.assertIn(">../materials/textures/map.png<", scene.read_text())


class Pipes(ConfineTest):
    """Everything that is opened is a regular file: a pipe without a writer would wait for ever."""

    def setUp(self):
        super().setUp()
        os.mkfifo(self.folder / "scene/pipe.png")
        for name in ("pipe.h", "pipe.sl", "pipe.dae", "pipe.pts", "pipe.bin", "pipe.glb", "pipe.xsd"):
            os.mkfifo(self.folder / "scene" / name)
        self.textured = self.write("scene/textured.dae", dae.textured(path="pipe.png"))

    def test_no_program_waits_for_an_image(self):
        _, said = self.picture(self.textured)
        self.assertIn("FILE_MISSING", said)
        self.expect(run("kinora-convert", self.textured, self.folder / "o.glb"), 0)
        self.expect(run("kinora-convert", self.textured, self.folder / "o.dae"), 0)
        self.assertIn("FILE_MISSING", str(self.codes(self.textured, "--info")))
        os.symlink("pipe.png", self.folder / "scene/link.png")
        os.symlink("/dev/zero", self.folder / "scene/zero.png")
        for name in ("pipe.png", "link.png", "zero.png", "/dev/zero", "/dev/tty"):
            scene = self.scene(Maps.TEXTURED.format("", f'"{name}"'))
            self.assertIn("IMAGE_UNREADABLE", self.picture(scene)[1])
            bound = self.scene(Maps.TEXTURED.format('string map = ""', "map"),
                               binds=f'<bind symbol="map"><string>{name}</string></bind>')
            self.expect(run("kinora-convert", bound, self.folder / "p.glb"), 0)
            self.expect(shade("run", f"{bound}#fx", "-o", self.folder / "s.png", "--size", "4x4"), 0)

    def test_none_waits_for_what_shaders_read(self):
        scene = self.scene('#include "pipe.h"\n' + GREEN.format("1"))
        self.picture(scene, code=4)
        self.expect(shade("check", f"{scene}#fx"), 4)
        self.codes(scene)
        _, said = self.picture(self.scene(PointFiles.READ.format("pipe.pts")))
        self.assertIn("POINT_FILE_UNREADABLE", said)
        _, said = self.picture(self.scene(PointFiles.BAKE.format("pipe.pts")), code=1)
        self.assertTrue(stat.S_ISFIFO(os.stat(self.folder / "scene/pipe.pts").st_mode))
        effect = """<effect id="fx"><profile_RSL><technique sid="t"><include sid="i" url="pipe.sl"/>
<pass><shader stage="SURFACE"/></pass></technique></profile_RSL></effect>"""
        scene = self.write("scene/main.dae", dae.plain(effects=effect))
        self.assertIn("RSL_INCLUDE_MISSING", self.picture(scene, code=4)[1])
        plain = self.scene(GREEN.format("1"))
        self.picture(plain, "--shader", f"mat={self.folder}/scene/pipe.sl", code=4)
        self.expect(run("kinora-convert", plain, self.folder / "o.dae", "--shader",
                        f"mat={self.folder}/scene/pipe.sl"), 4)

    def test_none_waits_for_a_document_or_a_buffer(self):
        for name in ("pipe.dae", "pipe.glb"):
            pipe = self.folder / "scene" / name
            self.picture(pipe, code=3)
            self.expect(run("kinora-convert", pipe, self.folder / "o.glb"), 3)
        self.expect(run("kinora-validate", self.folder / "scene/pipe.dae"), 3)
        self.expect(run("kinora-validate", "--fix", self.folder / "scene/pipe.dae"), 3)
        linked = self.write("scene/linked.dae", dae.document(dae.node(dae.shown("pipe.dae#house")), geometries=" "))
        self.assertIn("LINK_EXTERNAL_MISSING", str(self.codes(linked)))
        gltf = self.write("scene/a.gltf", json.dumps({
            "asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "pipe.bin"}]}))
        self.picture(gltf, code=3)


class PointFiles(ConfineTest):
    BAKE = 'surface s() {{ Oi = 1; Ci = 1; bake3d("{}", "", P, normalize(N), "a", 1); }}'
    READ = ('surface s() {{ Oi = 1; float a = 0; float ok = texture3d("{}", P, normalize(N), "a", a);'
            " Ci = ok * a; }}")

    def test_baking_writes_in_the_scene_s_folder(self):
        os.mkdir(self.folder / "else")
        self.picture(self.scene(self.BAKE.format("a.pts")), cwd=self.folder / "else")
        self.assertTrue((self.folder / "scene/a.pts").read_bytes().startswith(b"KNPOINT1"))
        self.assertEqual(os.listdir(self.folder / "else"), [])
        lit, said = self.picture(self.scene(self.READ.format("a.pts")), cwd=self.folder / "else")
        dark, _ = self.picture(self.scene(self.READ.format("b.pts")))
        self.assertNotEqual(lit, dark)

    def test_baking_writes_nowhere_else(self):
        os.symlink(self.folder / "secret", self.folder / "scene/linked")
        before = sorted(os.listdir(self.folder / "secret"))
        for name in ("../secret/a.pts", str(self.folder / "secret/a.pts"), "linked/a.pts", "../a.pts"):
            scene = self.scene(self.BAKE.format(name))
            _, said = self.picture(scene, code=1)
            self.assertIn("RSL_FILE_OUTSIDE", said)
            self.assertIn("lies outside the scene's folder", said)
            self.assertEqual(sorted(os.listdir(self.folder / "secret")), before)
            self.assertFalse((self.folder / "a.pts").exists())
        self.picture(self.scene(self.BAKE.format("../secret/a.pts")), "--allow-external", self.folder / "secret")
        self.assertTrue((self.folder / "secret/a.pts").exists())

    def test_baking_replaces_nothing_but_point_files(self):
        before = (self.folder / "scene/own.h").read_bytes()
        _, said = self.picture(self.scene(self.BAKE.format("own.h")), code=1)
        self.assertIn("no point file", said)
        self.assertEqual((self.folder / "scene/own.h").read_bytes(), before)

    def test_point_files_outside_are_not_read(self):
        self.picture(self.scene(self.BAKE.format("a.pts")))
        os.rename(self.folder / "scene/a.pts", self.folder / "secret/a.pts")
        scene = self.scene(self.READ.format("../secret/a.pts"))
        dark, said = self.picture(scene)
        self.assertIn("RSL_FILE_OUTSIDE", said)
        lit, _ = self.picture(scene, "--allow-external", self.folder / "secret")
        self.assertNotEqual(lit, dark)


class Sources(ConfineTest):
    def test_shader_files_of_the_document(self):
        os.symlink(self.folder / "secret/s.sl", self.folder / "scene/link.sl")
        own, _ = self.picture(self.scene(GREEN.format("color(0, 1, 0)")))
        effect = """<effect id="fx"><profile_RSL><technique sid="t"><include sid="i" url="{}"/>
<pass><shader stage="SURFACE"/></pass></technique></profile_RSL></effect>"""
        secret = self.folder / "secret/s.sl"
        for url in ("../secret/s.sl", f"file://{secret}", f"FiLe://{secret}", str(secret), "link.sl",
                    "%2e%2e/secret/s.sl", "%2E%2E%2Fsecret/s.sl"):
            scene = self.write("scene/main.dae", dae.plain(effects=effect.format(url)))
            refused, said = self.picture(scene)
            self.assertIn("LINK_OUTSIDE", said, url)
            self.assertNotEqual(refused, own)
            allowed, said = self.picture(scene, "--allow-external", self.folder / "secret")
            self.assertEqual(allowed, own, (url, said))

    def test_an_archive_holds_its_scene_to_its_members(self):
        self.write_bytes("map.png", dae.png(dae.picture()))
        for name in ("../map.png", str(self.folder / "map.png")):
            code = Maps.TEXTURED.format("", f'"{name}"')
            scene = dae.plain(effects=RSL.format(code=code, params="", binds=""))
            path = self.folder / "a.zae"
            with zipfile.ZipFile(path, "w") as archive:
                archive.writestr("main.dae", scene)
                archive.writestr("../map.png", (self.folder / "map.png").read_bytes())
                archive.writestr(str(self.folder / "planted.png"), b"x")
                link = zipfile.ZipInfo("link.png")
                link.external_attr = 0o120777 << 16
                archive.writestr(link, str(self.folder / "map.png"))
            _, said = self.picture(path)
            self.assertIn("RSL_FILE_OUTSIDE", said)
            self.assertIn("ARCHIVE_MEMBER", said)
            self.assertFalse((self.folder / "planted.png").exists())

    def test_an_archive_is_not_baked_into(self):
        scene = dae.plain(effects=RSL.format(code=PointFiles.BAKE.format("a.pts"), params="", binds=""))
        path = self.folder / "a.zae"
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("main.dae", scene)
        _, said = self.picture(path, code=1)
        self.assertIn("cannot write", said)
        os.mkdir(self.folder / "out")
        self.picture(path, "--allow-external", self.folder / "out")
        self.assertTrue((self.folder / "out/a.pts").exists())


if __name__ == "__main__":
    main()
