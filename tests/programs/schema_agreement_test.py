"""tests/programs/schema_agreement_test.py: what the element table calls valid is what xmllint calls
valid by the XSD the table prints, and by the official XSD but for what that one has wrong.

KINORA_SCHEMA_MUTANTS sets how many damaged documents are compared per version (default 400)."""
import json
import os
import random
import shutil
import subprocess
import unittest
import xml.etree.ElementTree as ET
from pathlib import Path

import random_documents
from programs import BIN, SHARED, SOURCE, TEST_DATA, ProgramTest, main, run
from random_documents import Writer, damaged, local, namespace_version, write

VERDICTS = BIN.parent / "tests/schema_verdicts"
SCENES = SHARED / "scenes"
OFFICIAL = {"V14": Path("/usr/lib/opencollada/collada_schema_1_4_1.xsd"),
            "V15": Path("/usr/lib/opencollada/collada_schema_1_5.xsd")}
# Well-formed, but refused by the reader: depth, and any use of an entity.
REFUSED = {"XML_DEPTH.dae", "XML_ENTITY.dae", "XML_ENTITY.default.dae"}
NAMES = {"V14": "1.4.1", "V15": "1.5"}
MUTANTS = int(os.environ.get("KINORA_SCHEMA_MUTANTS", "400"))
DOCUMENTS = 200

# Of W3C's schema for xml: attributes and of MathML's, what the official XSDs refer to.
XML_XSD = """<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema"
 targetNamespace="http://www.w3.org/XML/1998/namespace"><xs:attribute name="base" type="xs:anyURI"/>
</xs:schema>"""
MATH_XSD = """<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema"
 targetNamespace="http://www.w3.org/1998/Math/MathML"><xs:element name="math"/></xs:schema>"""
CATALOG = """<catalog xmlns="urn:oasis:names:tc:entity:xmlns:xml:catalog">
<system systemId="http://www.w3.org/2001/03/xml.xsd" uri="xml.xsd"/>
<system systemId="http://www.w3.org/2001/xml.xsd" uri="xml.xsd"/>
<system systemId="http://www.w3.org/Math/XMLSchema/mathml2/mathml2.xsd" uri="math.xsd"/>
</catalog>"""

# What our XSD allows and the official one does not, all that the tests below may meet.
#   1.5: a restriction of a complex type that repeats none of its content forbids all of it, which
#   leaves these without any child: the six samplers and instances with their <extra>.
EMPTIED_15 = {"fx_sampler1D_type", "fx_sampler2D_type", "fx_sampler3D_type", "fx_samplerCUBE_type",
              "fx_samplerRECT_type", "fx_samplerDEPTH_type", "instance_image_type",
              "instance_camera_type", "instance_force_field_type", "instance_light_type",
              "instance_physics_material_type", "instance_joint_type"}
#   1.4.1: a pass of profile_GLSL and _CG needs at least one state. One of the choices is an abstract
#   element that nothing stands for; xmllint takes that one for nothing at all and asks for no state.
BEFORE_STATES = {"annotate", "color_target", "depth_target", "stencil_target", "color_clear",
                 "depth_clear", "stencil_clear", "draw"}
#   Both: profile_RSL and values of its types.
RSL_NAMES = {"profile_RSL", "point", "vector", "normal", "color", "matrix", "string", "array"}


def stateless_pass(path):
    return any(local(e) == "pass" and {local(c) for c in e} - {"extra"} <= BEFORE_STATES
               for e in ET.parse(path).getroot().iter())


XS = "{http://www.w3.org/2001/XMLSchema}"


def restricted_types():
    """Types of the official 1.5 schema that restrict another without repeating its content."""
    root = ET.parse(OFFICIAL["V15"]).getroot()
    return {t.get("name") for t in root.findall(f"{XS}complexType")
            for r in t.findall(f"{XS}complexContent/{XS}restriction") if not len(r)}


def emptied_names():
    """Names of elements of such a type."""
    root = ET.parse(OFFICIAL["V15"]).getroot()
    return {e.get("name") for e in root.iter(f"{XS}element") if e.get("type") in EMPTIED_15}


def emptied(path, names):
    """Has a document children where the official 1.5 schema has lost them?"""
    return any(local(e) in names and len(e) for e in ET.parse(path).getroot().iter())


@unittest.skipUnless(shutil.which("xmllint"), "xmllint is not installed")
class Agreement(ProgramTest):
    def setUp(self):
        super().setUp()
        for name, text in (("xml.xsd", XML_XSD), ("math.xsd", MATH_XSD), ("catalog.xml", CATALOG)):
            self.write(name, text)
        self.ours = {}
        for version, name in NAMES.items():
            text = subprocess.run([VERDICTS, "print", name], capture_output=True, text=True,
                                  check=True).stdout
            self.ours[version] = self.write(f"kinora_{version}.xsd", text)

    def table_says(self, paths):
        """path -> (valid, codes)"""
        done = subprocess.run([VERDICTS, "check"], input="".join(f"{p}\n" for p in paths),
                              capture_output=True, text=True, check=True)
        found = {}
        for line in done.stdout.splitlines():
            word, path, *codes = line.split("\t")
            found[path] = (word == "valid", codes)
        self.assertEqual(len(found), len(paths))
        return found

    def program_says(self, paths):
        """path -> (valid, codes), by kinora-validate."""
        done = run("kinora-validate", "--profile", "strict", "--only", "XML_,DOC_,SCHEMA_,ID_",
                   "--format", "json", *paths)
        found = {}
        for f in json.loads(done.out)["files"]:  # what it says of other documents is theirs
            codes = {x["code"] for x in f["findings"]
                     if x["severity"] == "error" and x.get("file") == f["file"]}
            found[f["file"]] = (not codes, sorted(codes))
        return found

    def xmllint_says(self, schema, paths):
        """path -> (valid, complaints)"""
        environment = dict(os.environ, XML_CATALOG_FILES=str(self.folder / "catalog.xml"))
        done = subprocess.run(["xmllint", "--noout", "--nonet", "--schema", schema, *paths],
                              capture_output=True, text=True, errors="replace", env=environment)
        self.assertNotIn("failed to compile", done.stderr)
        lines = done.stderr.splitlines()
        valid = {line[:-len(" validates")] for line in lines if line.endswith(" validates")}
        return {str(p): (str(p) in valid, [l[:300] for l in lines if l.startswith(f"{p}:")])
                for p in paths}

    def compare(self, version, schema, paths, allowed=lambda path: False, says=None):
        """The paths on which the verdicts differ, as text."""
        table, other = (says or self.table_says)(paths), self.xmllint_says(schema, paths)
        return [f"{p}: table {table[str(p)]}, xmllint {other[str(p)]}" for p in paths
                if table[str(p)][0] != other[str(p)][0] and not allowed(p)]

    def writer(self, version):
        if not OFFICIAL[version].exists():
            self.skipTest("opencollada-tools is not installed")
        table = random_documents.load_table(SOURCE)
        return Writer(table, version, random.Random(7))

    def documents(self, version):
        """Random valid documents; the types they use and those that exist."""
        writer = self.writer(version)
        roots = [writer.document() for _ in range(DOCUMENTS)]
        paths = []
        for i, root in enumerate(roots):
            paths.append(self.folder / f"{version}_{i}.dae")
            write(root, paths[-1])
        reached = {k for k in writer.schema.types if k in writer.used}
        return writer, roots, paths, reached

    def test_real_files(self):
        """The verdict is xmllint's on every .dae of the shared scenes, of the assets and tests."""
        paths = [p for folder in (SCENES, SOURCE / "assets", SOURCE / "tests", TEST_DATA)
                 if folder.exists() for p in sorted(folder.rglob("*.dae"))
                 if p.name not in REFUSED]
        versions = {p: namespace_version(p.read_text(errors="replace")) for p in paths}
        for version in NAMES:
            mine = [p for p in paths if versions[p] == version and b"\0" not in p.read_bytes()]
            for says in (self.table_says, self.program_says):
                self.assertEqual(self.compare(version, self.ours[version], mine, says=says), [])
        self.whole_if(SCENES.exists())

    def test_random_documents(self):
        """Valid documents that use nearly every type: by the table, our XSD and the official one."""
        lost = emptied_names() if OFFICIAL["V15"].exists() else set()
        for version in NAMES:
            writer, _, paths, reached = self.documents(version)
            unused = {k for k in writer.schema.types if k not in reached}
            self.assertLess(len(unused), len(writer.schema.types) * 0.05,
                            sorted(writer.schema.named[k] for k in unused))
            table = self.table_says(paths)
            self.assertEqual([(p, v) for p, v in table.items() if not v[0]], [])
            self.assertEqual(self.compare(version, self.ours[version], paths), [])
            official = self.compare(version, OFFICIAL[version], paths,
                                    lambda p: version == "V15" and emptied(p, lost))
            self.assertEqual(official, [])

    def test_damaged_documents(self):
        """One random change each: the table, our XSD and the official one agree on all."""
        lost = emptied_names() if OFFICIAL["V15"].exists() else set()
        for version in NAMES:
            writer, roots, _, _ = self.documents(version)
            chance = random.Random(11)
            names = sorted({c[1] for c in elements(writer.schema)} - {"%any", "%math"})
            names += ["bogus", "profile_RSL"]
            paths, kinds = [], {}
            for i in range(MUTANTS):
                root, kind = damaged(chance.choice(roots), names, chance)
                paths.append(self.folder / f"{version}_bad_{i}.dae")
                kinds[paths[-1]] = kind
                write(root, paths[-1])
            self.assertEqual(self.compare(version, self.ours[version], paths), [])
            official = self.compare(version, OFFICIAL[version], paths,
                                    lambda p: rsl(p) or (emptied(p, lost) if version == "V15"
                                                         else stateless_pass(p)))
            self.assertEqual(official, [])
            invalid = [p for p, v in self.table_says(paths).items() if not v[0]]
            self.assertGreater(len(invalid), MUTANTS // 3)

    def test_names_beyond_ascii_and_namespaces(self):
        uri = "http://www.collada.org/2005/11/COLLADASchema"
        asset = "<{0}asset><{0}created>2026-01-01T00:00:00Z</{0}created><{0}modified>2026-01-01T00:00:00Z</{0}modified></{0}asset>"
        plain = f'<COLLADA xmlns="{uri}" version="1.4.1">{asset.format("")}{{}}</COLLADA>'
        nodes = '<library_nodes><node id="{}"/></library_nodes>'
        texts = [plain.format(nodes.format(name)) for name in (
            "\u00e0", "a\u00b7", "\u00b7", "a\u2192b", "a\u00d7b", "a\U0001f600b", "\u0300a", "a\u0300", "a\u037eb", "\u4e2d\u6587",
            " g ", "g h", "\u0660", "a\u0660", "\u3007", "a:b")]
        inner = "<{0}library_nodes {1}><{0}node/></{0}library_nodes>"
        texts += [plain.format(inner.format(prefix, declared)) for prefix, declared in (
            ("c:", f'xmlns:c="{uri}"'), ("c:", 'xmlns:c="urn:x"'), ("", 'xmlns="urn:x"'))]
        texts += [f'<c:COLLADA xmlns:c="{uri}" {more} version="1.4.1">{asset.format("c:")}{inner.format(prefix, "")}</c:COLLADA>'
                  for prefix in ("c:", "", "d:") for more in ("", f'xmlns="{uri}"', f'xmlns:d="{uri}"') if prefix != "d:" or "d=" in more]
        paths = [self.write(f"{i}.dae", '<?xml version="1.0" encoding="utf-8"?>' + text) for i, text in enumerate(texts)]
        verdicts = [valid for valid, _ in self.xmllint_says(self.ours["V14"], paths).values()]
        self.assertGreater(min(verdicts.count(True), verdicts.count(False)), 5)
        for says in (self.table_says, self.program_says):
            self.assertEqual(self.compare("V14", self.ours["V14"], paths, says=says), [])

    def test_the_official_schemas_lose_the_content_of_restricted_types(self):
        """The differences above are all, and real: it refuses what the specification shows."""
        writer = self.writer("V15")
        self.assertEqual(restricted_types(), EMPTIED_15)
        root = writer.document()
        uri = random_documents.URI["V15"]
        library = ET.SubElement(root, f"{{{uri}}}library_effects")
        root.remove(library)
        root.insert(1, library)
        effect = ET.fromstring(
            f'<effect xmlns="{uri}" id="e"><newparam sid="s"><sampler2D><instance_image url="#i"/>'
            '</sampler2D></newparam><profile_COMMON><technique sid="t"><constant/></technique>'
            "</profile_COMMON></effect>")
        library.append(effect)
        path = self.folder / "sampler.dae"
        for e in list(root)[2:]:
            root.remove(e)
        write(root, path)
        self.assertTrue(self.table_says([path])[str(path)][0])
        self.assertTrue(self.xmllint_says(self.ours["V15"], [path])[str(path)][0])
        self.assertFalse(self.xmllint_says(OFFICIAL["V15"], [path])[str(path)][0])

    def test_the_program_prints_the_schemas(self):
        for version, name in NAMES.items():
            self.assertEqual(run("kinora-validate", "--print-schema", name).out,
                             self.ours[version].read_text())

    def test_rsl_is_part_of_our_schemas(self):
        matte = SOURCE / "assets/scenes/matte.dae"
        self.assertTrue(self.table_says([matte])[str(matte)][0])
        self.assertTrue(self.xmllint_says(self.ours["V14"], [matte])[str(matte)][0])

    def test_the_tables_are_as_the_script_draws_them(self):
        if not OFFICIAL["V14"].exists():
            self.skipTest("opencollada-tools is not installed")
        done = subprocess.run([SOURCE / "scripts/collada_table", "--check"], capture_output=True,
                              text=True)
        self.assertEqual((done.returncode, done.stdout), (0, ""))


def elements(schema):
    def walk(content):
        if content and content[0] == "element":
            yield content
        elif content and content[0] != "group":
            for part in content[1]:
                yield from walk(part)
    for content in [t.content for t in schema.types.values()] + list(schema.groups.values()):
        yield from walk(content)


def rsl(path):
    """Has a document something that profile_RSL brings?"""
    root = ET.parse(path).getroot()
    parents = {"newparam", "setparam"}
    return any(local(e) == "profile_RSL" or (local(e) in parents and
                                             any(local(c) in RSL_NAMES for c in e))
               for e in root.iter())


if __name__ == "__main__":
    main()
