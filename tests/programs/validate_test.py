"""tests/programs/validate_test.py: kinora-validate as its users run it."""
import json
import os
import re
import shutil
import subprocess
import tempfile
import xml.etree.ElementTree as ET
import zipfile

from programs import MATTE, SCENES, ProgramTest, command, main, run

HEAD = ('<?xml version="1.0" encoding="utf-8"?>\n<COLLADA xmlns="http://www.collada.org/2005/11/'
        'COLLADASchema" version="1.4.1">\n<asset><created>2020-01-01T00:00:00Z</created>'
        '<modified>2020-01-01T00:00:00Z</modified><up_axis>Y_UP</up_axis></asset>\n')
# A scene that is valid and has nothing in it.
EMPTY = HEAD + ('<library_visual_scenes><visual_scene id="v"><node id="n"/></visual_scene>'
                '</library_visual_scenes>\n<scene><instance_visual_scene url="#v"/></scene>\n'
                '</COLLADA>\n')


def validate(*words, **options):
    return run("kinora-validate", *words, **options)


def findings(*words, **options):
    """The findings of the first file, from JSON."""
    return json.loads(validate("--format", "json", *words, **options).out)["files"][0]["findings"]


def codes(*words, **options):
    return [f["code"] for f in findings(*words, **options)]


class Findings(ProgramTest):
    def test_our_own_scenes_are_clean(self):
        report = json.loads(validate("-r", SCENES, "--format", "json").out)
        for file in report["files"]:
            self.assertEqual((file["errors"], file["warnings"]), (0, 0), file["findings"])

    def test_a_finding_has_place_code_path_and_caret(self):
        scene = self.write("s.dae", EMPTY.replace('url="#v"', 'url="#w"'))
        result = validate(scene)
        self.expect(result, 1, "s.dae:5:36: error: ", "[LINK_UNRESOLVED]",
                    "in scene/instance_visual_scene", " ^~\n")

    def test_errors_of_embedded_shaders_have_the_document_s_place(self):
        text = MATTE.read_text().replace("diffuse(", "difuse(")
        scene = self.write("s.dae", text)
        line, row = next((i, r) for i, r in enumerate(text.splitlines(), 1) if "difuse(" in r)
        result = validate(scene)
        self.expect(result, 1, f"s.dae:{line}:{row.index('difuse(') + 1}: error: ",
                    "library_effects/effect[@id='Matte']/profile_RSL", "did you mean 'diffuse'")

    def test_what_is_no_xml_is_said_once(self):
        result = validate(self.write("a.dae", "/* a shader */"))
        self.expect(result, 1, "a.dae:1:1: error: not well-formed: invalid token [XML_SYNTAX]")

    def test_binds_that_fit_no_parameter(self):
        text = MATTE.read_text()
        self.assertIn('symbol="', text)
        wrong = text.replace('symbol="', 'symbol="x', 1)
        self.assertIn("RSL_BIND_UNKNOWN", codes(self.write("s.dae", wrong)))

    def test_exit_codes(self):
        good = self.write("good.dae", EMPTY)
        broken = self.write("broken.dae", EMPTY[:-12])
        self.expect(validate(good), 0, "1 file: no findings")
        self.expect(validate(broken), 1, "XML_SYNTAX")
        self.expect(validate(self.folder / "none.dae"), 3, "XML_OPEN")
        self.expect(validate(self.folder), 3, "-r")
        self.assertEqual(validate().code, 2)
        self.assertEqual(validate("--format", "yaml", good).code, 2)
        self.assertEqual(validate(good, broken, self.folder / "none.dae").code, 3)

    def test_stdin_and_directories(self):
        self.expect(validate("-", stdin=EMPTY[:-12]), 1, "<stdin>:")
        for name in ("b/x.dae", "a/y.DAE", "a/c/z.dae", "a/text.txt"):
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            self.write(name, EMPTY)
        names = [f["file"] for f in json.loads(
            validate("-r", self.folder, "--format", "json").out)["files"]]
        self.assertEqual([n[len(str(self.folder)) + 1:] for n in names],
                         ["a/c/z.dae", "a/y.DAE", "b/x.dae"])


class Options(ProgramTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write("s.dae", EMPTY.replace('url="#v"', 'url="v"').replace("Y_UP", "W_UP"))

    def test_severities_and_what_fails(self):
        self.assertEqual(validate(self.scene).code, 0)
        self.assertEqual(validate(self.scene, "--fail-on", "warning").code, 1)
        self.assertEqual(validate(self.scene, "--severity", "LINK_NO_HASH=error").code, 1)
        self.assertEqual(validate(self.scene, "--profile", "strict").code, 1)
        off = validate(self.scene, "--severity", "LINK_*=off")
        self.assertNotIn("LINK_NO_HASH", off.out)
        self.expect(validate(self.scene, "--severity", "LINK_NO_HAS=off"), 2,
                    "did you mean LINK_NO_HASH")

    def test_profiles_choose_the_version(self):
        for profile, wrong in (("1.4.1", False), ("1.5", True)):
            found = codes(self.write("v.dae", EMPTY), "--profile", profile)
            self.assertEqual("DOC_NAMESPACE" in found, wrong, found)
        image = self.write("i.dae", EMPTY.replace(
            "<library_visual", '<library_images><image id="i"><init_from><ref>a.png</ref></init_from>'
            "</image></library_images><library_visual", 1))
        self.assertTrue(any(c.startswith("SCHEMA_") for c in codes(image, "--profile", "1.4.1")))
        self.assertFalse(any(c.startswith("SCHEMA_") for c in codes(image, "--profile", "1.5")))
        self.assertEqual(validate("--profile", "1.6", image).code, 2)

    def test_only_and_max_issues(self):
        self.assertTrue(all(c.startswith("LINK_") for c in codes(self.scene, "--only", "LINK_")))
        self.assertNotIn("LINK_NO_HASH", codes(self.scene, "--only", "XML_,DOC_"))
        self.assertEqual(len(codes(self.scene, "--max-issues", "1")), 1)

    def test_every_code_is_explained(self):
        rules = json.loads(validate("--list-rules", "--format", "json").out)
        self.assertGreater(len(rules), 150)
        for rule in rules[::10]:
            self.expect(validate("--explain", rule["code"]), 0, rule["code"], rule["severity"])
        every = validate("--explain", "all").out
        for rule in rules:
            self.assertIn(rule["code"] + " (", every)
        self.expect(validate("--explain", "NODE_SINGLAR"), 2)

    def test_any_number_of_threads_gives_the_same_bytes(self):
        files = [MATTE, self.scene, self.folder / "none.dae"] * 30
        for report in ("text", "json", "sarif", "junit", "html"):
            one = validate(*files, "-j", "1", "--format", report).out
            self.assertEqual(one, validate(*files, "-j", "4", "--format", report).out)

    def test_schemas_are_printed(self):
        for version in ("1.4.1", "1.5"):
            schema = ET.fromstring(validate("--print-schema", version).out)
            self.assertTrue(schema.tag.endswith("}schema"))
        for word in ("2.0", "1.5x", "1.4.7"):
            self.expect(validate("--print-schema", word), 2, "1.4.1", "1.5")

    def test_prefixes_of_no_code_are_refused(self):
        for option in (("--severity", "FOO*=off"), ("--only", "FOO")):
            self.expect(validate(*option, MATTE), 2, "'FOO'", "SCHEMA_")
        self.expect(validate("--severity", "schema_*=off", MATTE), 0)

    def test_info_and_budgets(self):
        found = json.loads(validate("--info", "--format", "json", MATTE).out)["files"][0]["info"]
        self.assertEqual(found["up_axis"], "Y")
        self.assertGreater(found["triangles"], 0)
        for low, high in zip(found["bounds"]["min"], found["bounds"]["max"]):
            self.assertLessEqual(low, high)
        self.expect(validate("--info", MATTE), 0, f"triangles        {found['triangles']}\n", " m\n")
        most = found["triangles"]
        self.assertEqual(validate("--budget", f"triangles={most},joints=64", MATTE).code, 0)
        self.expect(validate("--budget", f"triangles={most - 1}", MATTE), 1, "BUDGET_EXCEEDED")
        self.expect(validate("--budget", "triangels=3", MATTE), 2, "triangles")

    def test_bounds_are_metres_of_the_rest_pose(self):
        scene = self.write("s.dae", HEAD.replace("</asset>", '<unit name="inch" meter="0.0254"/>'
                           "</asset>") + """<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 2 0</float_array><technique_common>
<accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y"
type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s">
<node id="n"><translate>10 0 0</translate><rotate>0 0 1 90</rotate><scale>2 1 1</scale>
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>""")
        info = json.loads(validate("--info", "--format", "json", scene).out)["files"][0]["info"]
        # (x, y) becomes (10 - y, 2 x) inches.
        for found, inches in zip(info["bounds"]["min"] + info["bounds"]["max"],
                                 (8, 0, 0, 10, 2, 0)):
            self.assertAlmostEqual(found, inches * 0.0254, places=9)

    def test_quiet_and_verbose(self):
        self.assertEqual(validate("-q", self.scene).out, "")
        self.expect(validate("-v", self.scene), 0, "why: ", "s.dae: 3 warnings")

    def test_a_report_goes_to_a_file_whole_or_not_at_all(self):
        report = self.folder / "report.json"
        self.expect(validate("--format", "json", "-o", report, self.scene), 0)
        self.assertEqual(len(json.loads(report.read_text())["files"]), 1)
        self.expect(validate("-o", self.folder / "none/report.txt", self.scene), 6, "cannot write")


BAD = HEAD.replace("<created>2020-01-01T00:00:00Z</created>", "").replace(
    "</asset>", "<!-- kept --><created>2020-01-01T00:00:00Z</created></asset>") + """<library_lights/>
<library_images>
  <image id="i"><init_from>tex\\my wood.png</init_from></image>
  <image id="j"><init_from>file:///C:/a/b/Stone.png</init_from></image>
</library_images>
<library_geometries><geometry id="g"><mesh>
  <source id="p">
    <float_array id="pa" count="8">0 0 0  1,5 0 0  0 1 0</float_array>
    <technique_common><accessor source="#pa" count="4" stride="3">
      <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
    </accessor></technique_common>
  </source>
  <triangles count="2"><input semantic="VERTEX" source="v" offset="0"/><p>0 1 2</p></triangles>
  <vertices id="v"><input semantic="POSITION" source="p"/></vertices>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">
  <node id="n"><instance_geometry url="g"/></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene>
</COLLADA>"""

REPAIRED = {"SCHEMA_ORDER", "SCHEMA_EMPTY_LIBRARY", "SRC_COUNT", "SRC_ACCESSOR_COUNT", "PRIM_COUNT",
            "SRC_COMMA_DECIMAL", "LINK_NO_HASH", "SRC_NO_HASH", "FILE_BACKSLASH", "FILE_ABSOLUTE",
            "FILE_HOST", "FILE_SPACE", "FILE_CASE", "FILE_FALLBACK"}


SCHEMA = """<?xml version="1.0"?>
<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema" targetNamespace="urn:light" xmlns="urn:light"
           elementFormDefault="qualified">
  <xs:include schemaLocation="types.xsd"/>
  <xs:element name="lamp"><xs:complexType><xs:sequence>
    <xs:element name="watt" type="watts" maxOccurs="2"/>
  </xs:sequence><xs:attribute name="on" type="xs:boolean" use="required"/></xs:complexType></xs:element>
</xs:schema>
"""
TYPES = """<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema" targetNamespace="urn:light" xmlns="urn:light">
  <xs:simpleType name="watts"><xs:restriction base="xs:integer"><xs:maxInclusive value="100"/></xs:restriction>
  </xs:simpleType>
</xs:schema>
"""


class Foreign(ProgramTest):
    """Elements of other makers by their own schema."""

    def setUp(self):
        super().setUp()
        self.write("scene/light.xsd", SCHEMA)
        self.write("scene/types.xsd", TYPES)

    def scene(self, lamp, schema="light.xsd", name="scene/s.dae", xmlns="xmlns:l='urn:light'"):
        return self.write(name, EMPTY.replace('version="1.4.1"', f"""version="1.4.1" {xmlns}
 xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
 xsi:schemaLocation="http://www.collada.org/2005/11/COLLADASchema http://example.org/c.xsd urn:light {schema}\"""")
            .replace('<node id="n"/>', f"""<node id="n"><extra><technique profile="LIGHTS">
{lamp}
</technique></extra></node>"""))

    def foreign(self, *words):
        return [(f["line"], f["column"], f["severity"], f["message"]) for f in findings(*words)
                if f["code"] == "SCHEMA_FOREIGN"]

    def test_what_fits_says_nothing(self):
        self.assertEqual(self.foreign(self.scene('<l:lamp on="true"><l:watt>60</l:watt></l:lamp>')), [])
        own = '<lamp xmlns="urn:light" on="1"><watt>1</watt><watt>2</watt></lamp>'
        self.assertEqual(self.foreign(self.scene(own, xmlns="")), [])

    def test_what_does_not_fit_is_said_at_its_place(self):
        scene = self.scene('<l:lamp>\n  <l:watt>60</l:watt>\n  <l:bulb/></l:lamp><l:lamp on="maybe"><l:watt>1000</l:watt></l:lamp>')
        lines = scene.read_text().split("\n")
        lamp = next(i for i, row in enumerate(lines, 1) if row == "<l:lamp>")
        found = self.foreign(scene)
        self.assertEqual({severity for _, _, severity, _ in found}, {"warning"})
        places = {(line - lamp, column) for line, column, _, _ in found}
        self.assertIn((0, 1), places)  # no attribute "on"
        self.assertIn((2, 3), places)  # <bulb>
        second = lines[lamp + 1].index("<l:lamp on") + 1
        self.assertIn((2, second + len('<l:lamp on="')), places)  # "maybe"
        self.assertIn((2, lines[lamp + 1].index("<l:watt>1000") + 1), places)
        said = " ".join(message for *_, message in found)
        for word in ("bulb", "'on' is required", "maybe", "1000"):
            self.assertIn(word, said)
        self.expect(validate(scene), 0, "[SCHEMA_FOREIGN]")
        self.expect(validate("--fail-on", "warning", scene), 1)

    def test_a_schema_that_is_not_here_is_said_to_be_unread(self):
        lamp = "<l:lamp/>"
        for schema, why in (("http://example.org/light.xsd", "no local file"),
                            ("HTTPS://example.org/light.xsd", "no local file"),
                            ("none.xsd", "there is no file"),
                            ("../other/light.xsd", "outside the scene's folder"),
                            ("%2e%2e/other/light.xsd", "outside the scene's folder"),
                            ("File:///etc/passwd", "outside the scene's folder")):
            self.write("other/light.xsd", SCHEMA)
            self.write("other/types.xsd", TYPES)
            found = self.foreign(self.scene(lamp, schema))
            self.assertEqual(len(found), 1, (schema, found))
            self.assertEqual(found[0][2], "info")
            self.assertIn("not checked", found[0][3])
            self.assertIn(why, found[0][3])
        allowed = self.foreign("--allow-external", self.folder / "other", self.scene(lamp, "../other/light.xsd"))
        self.assertIn("'on' is required", " ".join(message for *_, message in allowed))

    def test_a_schema_reads_nothing_outside_either(self):
        self.write("other/types.xsd", TYPES)
        secret = self.write("other/secret.txt", "the-secret-word")
        wrong = {
            "include.xsd": SCHEMA.replace("types.xsd", "../other/types.xsd"),
            "remote.xsd": SCHEMA.replace("types.xsd", "http://127.0.0.1:9/types.xsd"),
            "entity.xsd": SCHEMA.replace('<?xml version="1.0"?>', '<!DOCTYPE x [<!ENTITY e SYSTEM '
                                         f'"file://{secret}">]>').replace('name="lamp"', 'name="&e;"'),
            "broken.xsd": SCHEMA[:200],
        }
        os.symlink(self.folder / "other/types.xsd", self.folder / "scene/link.xsd")
        wrong["symlink.xsd"] = SCHEMA.replace("types.xsd", "link.xsd")
        for name, text in wrong.items():
            self.write("scene/" + name, text)
            result = validate("-v", self.scene('<l:lamp on="1"><l:watt>1</l:watt></l:lamp>', name))
            self.assertIn(result.code, (0, 1))
            self.assertIn("SCHEMA_FOREIGN", result.out, name)
            self.assertIn("cannot be used", result.out, name)
            self.assertNotIn("the-secret-word", result.out + result.err)

    def test_entities_of_a_schema_do_not_multiply(self):
        bomb = "".join(f'<!ENTITY e{i} "{f"&e{i - 1};" * 10}">' for i in range(1, 10))
        self.write("scene/bomb.xsd", SCHEMA.replace(
            '<?xml version="1.0"?>', f'<!DOCTYPE x [<!ENTITY e0 "boom">{bomb}]>').replace('name="watt"', 'name="&e9;"'))
        result = validate("-v", self.scene("<l:lamp/>", "bomb.xsd"))
        self.assertIn("cannot be used", result.out)


class Fix(ProgramTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write("bad.dae", BAD)
        (self.folder / "tex").mkdir()
        for name in ("tex/my wood.png", "stone.png"):
            (self.folder / name).write_bytes(b"\x89PNG\r\n\x1a\n" + b"\0" * 30)

    def test_what_is_repaired_is_not_found_again(self):
        before = set(codes(self.scene))
        self.assertLessEqual({"SCHEMA_ORDER", "SRC_COUNT", "SRC_COMMA_DECIMAL", "PRIM_COUNT",
                              "SRC_ACCESSOR_COUNT", "SCHEMA_EMPTY_LIBRARY", "FILE_FALLBACK",
                              "LINK_NO_HASH"}, before)
        self.expect(validate("--fix", "--in-place", self.scene), 0, "repaired")
        self.assertEqual(set(codes(self.scene)) & REPAIRED, set())
        text = self.scene.read_text()
        for piece in ("<init_from>stone.png<", "1.5 0 0", 'count="9"', 'url="#g"', 'source="#v"',
                      'source="#p"', '<accessor source="#pa" count="3"', "<!-- kept -->"):
            self.assertIn(piece, text)
        # Twice is as good as once.
        self.expect(validate("--fix", "--in-place", self.scene), 0, "nothing to repair")
        self.assertEqual(self.scene.read_text(), text)

    def test_the_scene_means_the_same(self):
        def info():
            found = json.loads(validate("--info", "--format", "json", self.scene).out)
            return found["files"][0]["info"]
        before = info()
        self.assertEqual(before["bounds"]["max"], [1.5, 1, 0])
        validate("--fix", "--in-place", self.scene)
        self.assertEqual(before, info())

    def test_all_other_bytes_stay(self):
        strange = BAD.replace("\n", "\r\n", 3).replace(
            "<library_lights/>", "<!-- \t two  spaces --><library_lights/>")
        path = self.folder / "crlf.dae"
        path.write_bytes(b"\xef\xbb\xbf" + strange.encode())
        validate("--fix", "--only", "SRC_COMMA_DECIMAL", "--in-place", path)
        self.assertEqual(path.read_bytes(),
                         b"\xef\xbb\xbf" + strange.replace("1,5", "1.5").encode())

    def test_a_diff_is_what_in_place_does(self):
        diff = validate("--fix", "--diff", self.scene).out
        patch = self.write("d.patch", diff)
        copy = self.write("copy.dae", BAD)
        text = validate("--fix", self.scene).out
        self.assertEqual(self.scene.read_text(), BAD)
        if shutil.which("patch"):
            subprocess.run(["patch", "-s", copy, patch], check=True)
            self.assertEqual(copy.read_text(), text)
        validate("--fix", "--in-place", self.scene)
        self.assertEqual(self.scene.read_text(), text)
        self.assertEqual(validate("--fix", "--diff", self.scene).out, "")

    def image(self, path, name="image.dae"):
        return self.write(name, EMPTY.replace(
            "<library_visual_scenes>", f'<library_images><image id="i"><init_from>{path}</init_from>'
            "</image></library_images><library_visual_scenes>"))

    def test_the_case_of_a_file_s_name_is_made_its_own(self):
        scene = self.image("Stone.PNG")
        self.assertIn("FILE_CASE", codes(scene))
        self.expect(validate("--fix", "--only", "FILE_CASE", "--in-place", scene), 0, "1 FILE_CASE")
        self.assertIn("<init_from>stone.png<", scene.read_text())
        self.assertNotIn("FILE_CASE", codes(scene))

    def test_a_space_in_a_path_is_encoded(self):
        scene = self.image("tex/my wood.png")
        self.assertIn("FILE_SPACE", codes(scene))
        self.expect(validate("--fix", "--only", "FILE_SPACE", "--in-place", scene), 0, "1 FILE_SPACE")
        self.assertIn("<init_from>tex/my%20wood.png<", scene.read_text())
        self.assertNotIn("FILE_SPACE", codes(scene))
        both = self.image("Tex/My Wood.png", "both.dae")
        validate("--fix", "--in-place", both)
        self.assertIn("<init_from>tex/my%20wood.png<", both.read_text())
        self.assertFalse({"FILE_CASE", "FILE_SPACE", "FILE_MISSING"} & set(codes(both)))

    def test_other_encodings_become_utf8_with_their_repairs(self):
        text = BAD.replace("<!-- kept -->", "<!-- gr\u00fc\u00dfe -->")
        self.assertNotEqual(text, BAD)
        head = text[:text.index("?>") + 2]
        self.assertTrue(head.startswith("<?xml"))
        fixed = None
        for name, encoding, declared in (("utf16.dae", "utf-16", "UTF-16"), ("be.dae", "utf-16-be", "UTF-16"),
                                         ("latin.dae", "latin-1", "ISO-8859-1"), ("liar.dae", "latin-1", "utf-8")):
            path = self.folder / name
            body = f"<?xml version='1.0' encoding='{declared}'?>" + text[len(head):]
            path.write_bytes((b"\xfe\xff" if name == "be.dae" else b"") + body.encode(encoding))
            before = path.read_bytes()
            diff = validate("--fix", "--diff", path).out
            self.assertEqual(path.read_bytes(), before)
            self.assertIn("-    <float_array id=\"pa\" count=\"8\">0 0 0  1,5 0 0  0 1 0</float_array>", diff)
            self.expect(validate("--fix", "--in-place", path), 0, "repaired", "it is UTF-8 now")
            after = path.read_bytes().decode("utf-8")
            self.assertIn("encoding='utf-8'", after)
            self.assertIn("gr\u00fc\u00dfe", after)
            self.assertIn("1.5 0 0", after)
            self.assertEqual(set(codes(path)) & (REPAIRED | {"XML_RECODED", "XML_ENCODING"}), set())
            self.assertEqual(fixed or after, after)
            fixed = after
        whole = self.folder / "whole.dae"
        whole.write_bytes(EMPTY.replace("utf-8", "UTF-16").encode("utf-16"))
        before = whole.read_bytes()
        self.expect(validate("--fix", "--in-place", whole), 0, "nothing to repair")
        self.assertEqual(whole.read_bytes(), before)

    def test_an_output_file_that_nothing_is_written_to_stays(self):
        keep = self.write("keep.dae", EMPTY)
        archive = self.folder / "a.zae"
        with zipfile.ZipFile(archive, "w") as z:
            z.writestr("bad.dae", BAD)
        for file, code in ((self.folder / "none.dae", 3), (archive, 1), (self.write("empty.dae", ""), 1)):
            for words in ([], ["--diff"]):
                self.expect(validate("--fix", *words, file, "-o", keep), code)
                self.assertEqual(keep.read_text(), EMPTY)
        self.expect(validate("--fix", self.scene, "-o", keep), 0)
        self.assertIn("stone.png", keep.read_text())

    def test_a_link_stays_one_and_its_file_is_repaired(self):
        link = self.folder / "link.dae"
        link.symlink_to("bad.dae")
        self.expect(validate("--fix", "--in-place", link), 0, "repaired")
        self.assertTrue(link.is_symlink())
        self.assertIn("stone.png", self.scene.read_text())

    def test_letters_of_markup_in_a_file_s_name_stay_encoded(self):
        for name, uri in (("a&b.png", "a%26b.png"), ("it's.png", "it%27s.png")):
            (self.folder / name).write_bytes(b"\x89PNG\r\n\x1a\n" + b"\0" * 30)
            scene = self.image(f"file:///C:/t/{uri}")
            self.expect(validate("--fix", "--in-place", scene), 0, "repaired")
            self.assertIn(f"<init_from>{uri}</init_from>", scene.read_text())
            ET.parse(scene)

    def test_an_archive_is_not_repaired_and_that_is_said(self):
        path = self.folder / "a.zae"
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("bad.dae", BAD)
        before = path.read_bytes()
        for words in (["--in-place"], ["--diff"], []):
            result = validate("--fix", *words, path)
            self.expect(result, 1, "an archive is not repaired")
            self.assertEqual(result.out, "")
        self.assertEqual(path.read_bytes(), before)

    def test_what_cannot_be_repaired_is_reported(self):
        broken = self.write("broken.dae", BAD[:-12])
        self.expect(validate("--fix", "--in-place", broken), 1, "XML_SYNTAX")
        self.assertEqual(broken.read_text(), BAD[:-12])
        self.expect(validate("--fix", "--in-place", self.folder / "none.dae"), 3, "XML_OPEN")
        self.expect(validate("--fix", self.scene, broken), 2, "--in-place")
        self.assertEqual(validate("--diff", self.scene).code, 2)


class Shaders(ProgramTest):
    """profile_RSL through the real front end."""

    def change(self, old, new, count=1):
        text = MATTE.read_text()
        self.assertIn(old, text)
        return self.write("s.dae", text.replace(old, new, count))

    def test_stages_without_a_shader(self):
        self.assertIn("RSL_SHADER_MISSING", codes(self.change('stage="SURFACE"',
                                                              'stage="DISPLACEMENT"')))

    def test_errors_in_included_files_have_their_place_there(self):
        text = MATTE.read_text()
        begin, end = text.index("<code>"), text.index("</code>") + len("</code>")
        self.write("m.sl", "surface matte(float Kd = 1;)\n{\n    Ci = Kd * diffus(N);\n}\n")
        scene = self.write("s.dae", text[:begin] + '<include url="m.sl"/>' + text[end:])
        self.expect(validate(scene), 1, "m.sl:3:15: error")

    def test_scenes_without_rsl_know_no_rsl(self):
        self.assertFalse([c for c in codes(self.write("s.dae", EMPTY)) if c.startswith("RSL_")])


class Reports(ProgramTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write("a b.dae", EMPTY.replace('url="#v"', 'url="#w<\x1fé"').replace(
            "<asset>", "<asset><!-- é --><foo/>"))
        self.broken = self.write("broken.dae", EMPTY[:-12])
        self.files = [self.scene, MATTE, self.broken]

    def report(self, name):
        return validate("--format", name, *self.files)

    def test_json(self):
        report = json.loads(self.report("json").out)
        self.assertEqual([f["file"] for f in report["files"]], [str(f) for f in self.files])
        self.assertEqual(report["summary"]["exit_code"], 1)
        self.assertTrue(report["files"][1]["valid"])
        for f in (f for file in report["files"] for f in file["findings"]):
            self.assertLessEqual({"code", "severity", "message", "line", "column", "path"}, set(f))

    def check_sarif(self, value, schema, where="$"):
        """The rules of SARIF 2.1.0 that concern us, from the OASIS standard."""
        kinds = {"string": str, "array": list, "object": dict, "boolean": bool, "integer": int}
        if "kind" in schema:
            self.assertIsInstance(value, kinds[schema["kind"]], where)
        if "enum" in schema:
            self.assertIn(value, schema["enum"], where)
        if "least" in schema:
            self.assertGreaterEqual(value, schema["least"], where)
        if "pattern" in schema:
            self.assertRegex(value, schema["pattern"], where)
        for name in schema.get("required", ()):
            self.assertIn(name, value, where)
        if "properties" in schema:
            for name, item in value.items():
                self.assertIn(name, schema["properties"], where)
                self.check_sarif(item, schema["properties"][name], f"{where}.{name}")
        for i, item in enumerate(value if "items" in schema else ()):
            self.check_sarif(item, schema["items"], f"{where}[{i}]")

    def test_sarif_follows_the_standard(self):
        text = {"kind": "string"}
        message = {"kind": "object", "required": ["text"], "properties": {"text": text}}
        number = {"kind": "integer", "least": 1}
        level = {"enum": ["none", "note", "warning", "error"]}
        uri = {"kind": "string", "pattern": r"^[A-Za-z0-9\-._~:/?#\[\]@!$&'()*+,;=%]+$"}
        location = {"kind": "object", "properties": {
            "physicalLocation": {
                "kind": "object", "required": ["artifactLocation"], "properties": {
                    "artifactLocation": {"kind": "object", "properties": {"uri": uri}},
                    "region": {"kind": "object", "properties": {
                        k: number for k in ("startLine", "startColumn", "endLine", "endColumn")}}}},
            "logicalLocations": {"kind": "array", "items": {"kind": "object", "properties": {
                "fullyQualifiedName": text, "kind": text}}},
            "message": message}}
        rule = {"kind": "object", "required": ["id"], "properties": {
            "id": text, "shortDescription": message, "fullDescription": message, "help": message,
            "defaultConfiguration": {"kind": "object", "properties": {
                "enabled": {"kind": "boolean"}, "level": level}}}}
        result = {"kind": "object", "required": ["message"], "properties": {
            "ruleId": text, "ruleIndex": {"kind": "integer", "least": 0}, "level": level,
            "message": message, "locations": {"kind": "array", "items": location},
            "relatedLocations": {"kind": "array", "items": location}}}
        run_schema = {"kind": "object", "required": ["tool"], "properties": {
            "tool": {"kind": "object", "required": ["driver"], "properties": {"driver": {
                "kind": "object", "required": ["name"], "properties": {
                    "name": text, "version": text,
                    "semanticVersion": {"kind": "string", "pattern": r"^\d+\.\d+\.\d+"},
                    "rules": {"kind": "array", "items": rule}}}}},
            "columnKind": {"enum": ["utf16CodeUnits", "unicodeCodePoints"]},
            "invocations": {"kind": "array", "items": {
                "kind": "object", "required": ["executionSuccessful"], "properties": {
                    "executionSuccessful": {"kind": "boolean"}, "exitCode": {"kind": "integer"}}}},
            "results": {"kind": "array", "items": result}}}
        report = json.loads(self.report("sarif").out)
        self.check_sarif(report, {"required": ["version", "runs"], "properties": {
            "$schema": uri, "version": {"enum": ["2.1.0"]},
            "runs": {"kind": "array", "items": run_schema}}})
        one = report["runs"][0]
        ids = [rule["id"] for rule in one["tool"]["driver"]["rules"]]
        self.assertEqual(len(ids), len(set(ids)))
        self.assertTrue(one["results"])
        for found in one["results"]:
            self.assertEqual(ids[found["ruleIndex"]], found["ruleId"])
            self.assertTrue(found["locations"][0]["logicalLocations"][0]["fullyQualifiedName"])

    def test_sarif_counts_columns_in_characters(self):
        found = next(r for r in json.loads(self.report("sarif").out)["runs"][0]["results"]
                     if "foo" in r["message"]["text"])
        region = found["locations"][0]["physicalLocation"]["region"]
        line = self.scene.read_text().splitlines()[region["startLine"] - 1]
        self.assertTrue(line[region["startColumn"] - 1:].startswith("<foo/>"))

    def test_junit_is_xml_with_a_case_for_each_failure(self):
        suites = ET.fromstring(self.report("junit").out)
        self.assertEqual([s.get("name") for s in suites], [str(f) for f in self.files])
        good, broken = suites[1], suites[2]
        self.assertEqual(good.get("failures"), "0")
        self.assertEqual(len(good.findall("testcase")), 1)
        self.assertEqual(int(broken.get("failures")), len(broken.findall("testcase/failure")))
        self.assertTrue(any(f.get("type") == "XML_SYNTAX" for f in broken.iter("failure")))

    def test_a_file_that_fails_by_what_is_not_shown_is_no_success(self):
        # A warning is shown, the error behind it is not.
        scene = self.write("ju.dae", EMPTY.replace("<up_axis>", '<unit name="inch" meter="1"/><up_axis>')[:-3])
        for words, code in ((("--max-issues", "1", scene), 1), (("--only", "PRIM_", self.folder / "none.dae"), 3)):
            done = validate("--format", "junit", *words)
            self.assertEqual(done.code, code)
            suite = ET.fromstring(done.out)[0]
            failing = suite.findall("testcase/failure") + suite.findall("testcase/error")
            self.assertEqual(int(suite.get("failures")) + int(suite.get("errors")), len(failing))
            self.assertEqual(int(suite.get("tests")), len(suite.findall("testcase")))
            self.assertEqual(len(failing), 1)
            report = json.loads(validate("--format", "json", *words).out)
            self.assertFalse(report["files"][0]["valid"])

    def test_html_needs_nothing_else(self):
        page = self.report("html").out
        self.assertNotRegex(page, r"(?i)(src|href)\s*=|@import|url\(|https?://(?!www\.collada)")
        self.assertIn("&lt;foo/&gt;", page)
        self.assertNotIn("<foo/>", page)

    def test_html_filters_in_a_browser(self):
        chromium = shutil.which("chromium")
        if not chromium:
            self.skipTest("chromium is not installed")
        page = self.report("html").out
        # What a user does, done by a script in the page.
        page = page.replace("</body>", """<script>
            boxes.warning.checked = false; update();
            document.title = [items.length, items.filter(a => !a.hidden).length,
              items.filter(a => !a.hidden && a.dataset.severity === 'warning').length].join(' ');
            </script></body>""")
        file = self.write("page.html", page)
        with tempfile.TemporaryDirectory() as profile:
            dom = subprocess.run(
                [chromium, "--headless", "--no-sandbox", "--disable-gpu",
                 f"--user-data-dir={profile}", "--dump-dom", f"file://{file}"],
                capture_output=True, text=True, timeout=120).stdout
        title = re.search(r"<title>(\d+) (\d+) (\d+)</title>", dom)
        self.assertTrue(title, dom[:2000])
        every, shown, warnings = map(int, title.groups())
        self.assertEqual(every, page.count("<article "))
        self.assertEqual(warnings, 0)
        self.assertTrue(0 < shown < every)
        self.assertRegex(dom, r'id="shown">\d+ of \d+ shown')


class Batches(ProgramTest):
    def test_archives(self):
        archive = self.folder / "a.zae"
        with zipfile.ZipFile(archive, "w") as z:
            z.writestr("manifest.xml", '<?xml version="1.0"?><dae_root>m/s.dae</dae_root>')
            z.writestr("m/s.dae", MATTE.read_text().replace("diffuse(", "difuse("))
        self.expect(validate(archive), 1, "a.zae!m/s.dae:", "RSL_UNKNOWN_FUNCTION")

    def test_bad_files_do_not_stop_the_others(self):
        (self.folder / "d.dae").mkdir()
        (self.folder / "link.dae").symlink_to(self.folder / "nowhere.dae")
        (self.folder / "loop").symlink_to(self.folder)
        self.write("empty.dae", "")
        self.write("good.dae", EMPTY)
        (self.folder / "bytes.dae").write_bytes(bytes(range(256)) * 10)
        result = validate("-r", self.folder, "--format", "json")
        report = {os.path.basename(f["file"]): f for f in json.loads(result.out)["files"]}
        self.assertEqual(result.code, 3)
        self.assertEqual(set(report), {"link.dae", "empty.dae", "good.dae", "bytes.dae"})
        self.assertTrue(report["good.dae"]["valid"])
        self.assertFalse(report["link.dae"]["readable"])
        self.assertFalse(report["bytes.dae"]["valid"])

    def test_pipes_in_folders_are_passed_over(self):
        os.mkfifo(self.folder / "x.dae")
        self.write("good.dae", EMPTY)
        self.expect(validate("-r", self.folder), 0, "1 file:")

    def test_devices_are_refused(self):
        self.expect(validate("/dev/zero"), 3, "XML_OPEN")

    def test_a_reader_that_goes_away_ends_the_run(self):
        files = [str(self.write("s.dae", EMPTY.replace('url="#v"', 'url="#w"')))] * 5000
        program = subprocess.Popen([*command("kinora-validate"), *files], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        program.stdout.read(10)
        program.stdout.close()
        self.assertEqual(program.wait(timeout=60), validate(files[0]).code)  # that of what was reported
        self.assertEqual(program.stderr.read(), b"")
        program.stderr.close()

    def test_memory_does_not_grow_with_the_number_of_files(self):
        scene = self.write("s.dae", EMPTY.replace('url="#v"', 'url="#w"'))

        # AddressSanitizer keeps what is freed for a while; that is no growth of ours.
        sanitizer = os.environ.get("ASAN_OPTIONS", "") + ":quarantine_size_mb=1"

        def peak(count):
            result = validate(*[scene] * count, "-q", "--stats", "json", "-j", "2",
                              env=dict(os.environ, ASAN_OPTIONS=sanitizer))
            return json.loads(result.err)["peak_bytes"]
        self.assertLess(peak(4000), peak(200) + 16e6)


if __name__ == "__main__":
    main()
