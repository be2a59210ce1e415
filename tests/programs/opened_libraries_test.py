"""tests/programs/opened_libraries_test.py: libraries that a run opens when it needs them, and what is
said where one of them is broken: which, what it is for, and the package that brings it."""
import itertools
import os
import re
import struct
import subprocess
import unittest
import zipfile
import zlib

from programs import BIN, MATTE, ProgramTest, main, render, run

SMALL = ("--size", "16x12", "--spp", "1")
SCHEMA = """<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema" targetNamespace="urn:light">
<xs:element name="lamp" type="xs:int"/></xs:schema>"""
DOCUMENT = """<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"
 xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xmlns:l="urn:light"
 xsi:schemaLocation="urn:light light.xsd">
<asset><created>2026-01-01T00:00:00Z</created><modified>2026-01-01T00:00:00Z</modified></asset>
<library_nodes><node id="n"><extra><technique profile="L"><l:lamp>bright</l:lamp></technique></extra>
</node></library_nodes></COLLADA>"""


def installed(pattern):
    """Names of the dynamic linker's libraries."""
    listing = subprocess.run(["ldconfig", "-p"], capture_output=True, text=True,
                             env={**os.environ, "PATH": os.environ["PATH"] + ":/sbin"})
    names = re.findall(rf"^\s*({pattern}) ", listing.stdout, re.M)
    assert names, (pattern, listing)
    return names


def rows_of_zip_exr(data):
    """The bytes of each 16 rows ("OpenEXR File Layout"): zlib's, whose differences are summed up and
    whose halves are shuffled together."""
    at = 8
    while data[at]:  # attributes: name, type, size, value
        at = data.index(b"\0", data.index(b"\0", at) + 1) + 1
        at += 4 + struct.unpack_from("<i", data, at)[0]
    table = at + 1
    first, = struct.unpack_from("<Q", data, table)
    chunks = []
    for place in struct.unpack_from(f"<{(first - table) // 8}Q", data, table):
        size, = struct.unpack_from("<i", data, place + 4)
        differences = zlib.decompress(data[place + 8:place + 8 + size])
        summed = bytes(itertools.accumulate(differences, lambda a, b: (a + b - 128) % 256))
        half = (len(summed) + 1) // 2
        rows = bytearray(len(summed))
        rows[0::2], rows[1::2] = summed[:half], summed[half:]
        chunks.append(bytes(rows))
    return chunks


class OpenedLibraries(ProgramTest):
    def without(self, pattern):
        """An environment where these libraries are no libraries."""
        for name in installed(pattern):
            self.write(f"broken/{name}", "this is no library\n" * 100)
        return {**os.environ, "LD_LIBRARY_PATH": str(self.folder / "broken")}

    def expect_told(self, result, code, purpose, file, package):
        """`file`: of the library, or of our module that links it."""
        self.assertEqual(result.code, code, result)
        said = (result.out + result.err).replace("\n", " ")
        self.assertRegex(said, rf"{purpose} by {file}, which cannot be loaded \(.+\); "
                               rf"install {re.escape(package)}")

    def test_rays(self):
        broken = self.without(r"libembree3\.so\.\d+")
        picture = self.folder / "a.png"
        result = render(MATTE, "-o", picture, *SMALL, env=broken)
        self.expect_told(result, 3, "rays are traced", r"libembree3\.so\.\d+", "libembree3-3")
        self.assertIn("[RAY_TRACER_MISSING]", result.err)
        self.assertFalse(picture.exists())
        self.expect(run("kinora-convert", MATTE, self.folder / "b.dae", env=broken), 0)

    def test_threads(self):
        """Embree needs the scheduler, too; what traces no rays works on one thread."""
        broken = self.without(r"libtbb\.so\.\d+")
        result = render(MATTE, "-o", self.folder / "a.png", *SMALL, "--threads", "2", env=broken)
        self.expect_told(result, 3, "loops are shared among threads", r"libkinora_tasks\.so",
                         "libtbb12")
        self.expect_told(result, 3, "rays are traced", r"libembree3\.so\.\d+", "libembree3-3")
        self.expect(run("kinora-convert", MATTE, self.folder / "b.dae", env=broken), 0)

    def test_pictures(self):
        for pattern, suffix, purpose, file, package in (
                (r"libpng16\.so\.\d+", "png", "PNG pictures are read and written",
                 r"libpng16\.so\.\d+", "libpng16-16"),
                (r"libOpenEXR-\S+\.so\.\d+", "exr", "EXR pictures are read and written",
                 r"libkinora_exr\.so", "libopenexr-3-1-30")):
            with self.subTest(suffix):
                broken = self.without(pattern)
                picture = self.folder / f"a.{suffix}"
                result = render(MATTE, "-o", picture, *SMALL, env=broken)
                self.expect_told(result, 6, purpose, file, package)
                self.assertIn("[FRAME_UNWRITABLE]", result.err)
                self.assertEqual(list(self.folder.glob(f"*{suffix}*")), [])
                self.expect(render(MATTE, "-o", "null", *SMALL, env=broken), 0)

    def test_compression(self):
        """libdeflate is there to be fast: without it, OpenEXR's zlib makes the same picture."""
        files = [self.folder / "deflate.exr", self.folder / "zlib.exr"]
        for file, env in zip(files, (None, self.without(r"libdeflate\.so\.\d+"))):
            self.expect(render(MATTE, "-o", file, "--size", "67x53", "--spp", "1", env=env), 0)
        chunks = [rows_of_zip_exr(file.read_bytes()) for file in files]
        self.assertEqual(chunks[0], chunks[1])
        self.assertEqual([len(rows) for rows in chunks[0]], [67 * 8 * n for n in (16, 16, 16, 5)])
        self.assertNotEqual(*(file.read_bytes() for file in files))

    def test_archives(self):
        archive = self.folder / "a.zae"
        with zipfile.ZipFile(archive, "w") as packed:
            packed.write(MATTE, "matte.dae")
        broken = self.without(r"libzip\.so\.\d+")
        result = run("kinora-validate", archive, env=broken)
        self.expect_told(result, 1, "archives are read", r"libzip\.so\.\d+", "libzip4")
        self.expect(run("kinora-validate", MATTE, env=broken), 0)

    def test_schemas_of_other_makers(self):
        self.write("light.xsd", SCHEMA)
        scene = self.write("a.dae", DOCUMENT)
        self.expect(run("kinora-validate", scene), 0, "[SCHEMA_FOREIGN]")
        broken = self.without(r"libxml2\.so\.\d+")
        result = run("kinora-validate", scene, env=broken)
        self.expect_told(result, 0, "schemas of other makers are read", r"libxml2\.so\.\d+",
                         "libxml2")

    def test_textures(self):
        """OpenImageIO's absence is a finding of the texture; the scene is rendered with checks."""
        text = MATTE.read_text()
        self.assertIn("</library_effects>", text)
        broken = self.without(r"libOpenImageIO\.so\.\S+")
        image = self.write("t.tif", "II*\0 and no more")
        result = run("kinora-shade", "run", "--size", "4x4", self.write("t.sl", f"""surface t() {{
            Ci = color texture("{image}", 0.5, 0.5); }}"""), env=broken)
        self.expect_told(result, result.code, "images other than PNG are read",
                         r"libkinora_images\.so", "libopenimageio2.4")


if __name__ == "__main__":
    main()
