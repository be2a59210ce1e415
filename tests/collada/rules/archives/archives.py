#!/usr/bin/env python3
"""tests/collada/rules/archives/archives.py: writes the ARCHIVE_ files, which no editor can."""
import sys
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import compose  # noqa: E402

SCENE = compose.documents()["LINK_UNRESOLVED.ok.dae"].decode()  # any that is whole
MANIFEST = "<dae_root>scene.dae</dae_root>"
WHOLE = {"manifest.xml": MANIFEST, "scene.dae": SCENE}


def write(name, members):
    with zipfile.ZipFile(HERE / name, "w", zipfile.ZIP_DEFLATED) as archive:
        for member, content in members.items():
            archive.writestr(zipfile.ZipInfo(member, (2026, 11, 21, 0, 0, 0)), content,
                             zipfile.ZIP_DEFLATED, 9)


write("ARCHIVE_ROOT.zae", {"scene.dae": SCENE})
write("ARCHIVE_ROOT.gone.zae", {"manifest.xml": "<dae_root>gone.dae</dae_root>", "scene.dae": SCENE})
write("ARCHIVE_NO_SCENE.zae", {"readme.txt": "no scene"})
write("ARCHIVE_NESTED.zae", {"doc.kml": "<kml/>",
                             "models/inner.zae": (HERE / "ARCHIVE_ROOT.zae").read_bytes()})
write("ARCHIVE_NESTED.named.zae", {"manifest.xml": MANIFEST, "other.dae": SCENE,
                                   "scene.dae": (HERE / "ARCHIVE_ROOT.zae").read_bytes()})
write("ARCHIVE_NESTED.ok.zae", WHOLE | {"textures.zip": (HERE / "ARCHIVE_ROOT.zae").read_bytes()})
write("ARCHIVE_MEMBER.zae", WHOLE | {"../../outside.txt": "x"})
write("ARCHIVE_LIMIT.zae", WHOLE | {"zeros": bytes(80 << 20)})
def kml(*models):
    return "<kml><Folder>" + "".join(f"<Placemark><Model>{m}</Model></Placemark>" for m in models) + "</Folder></kml>"


LINK = "<Link><href>scene.dae</href></Link>"
PLACE = "<Location><longitude>{}</longitude><latitude>2</latitude></Location>"
for name, models in (("MODEL", (LINK, "<Link><href>gone.dae</href></Link>")),
                     ("PLACE", (LINK, PLACE.format("east") + LINK))):
    write(f"ARCHIVE_{name}.kmz", {"doc.kml": kml(*models), "scene.dae": SCENE})
    write(f"ARCHIVE_{name}.ok.kmz", {"doc.kml": kml(LINK, PLACE.format("1") + LINK), "scene.dae": SCENE})
for code in ("OPEN", "LIMIT", "MEMBER", "NO_SCENE", "ROOT"):
    write(f"ARCHIVE_{code}.ok.zae", WHOLE)
(HERE / "ARCHIVE_OPEN.zae").write_bytes((HERE / "ARCHIVE_OPEN.ok.zae").read_bytes()[:200])
