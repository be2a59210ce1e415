"""tests/programs/render/exr_files.py: EXR files through OpenImageIO, a reader that is not ours."""
import json
import subprocess

READER = "/usr/bin/python3"  # Debian's, which has python3-openimageio
SCRIPT = """
import json, sys
import OpenImageIO as oiio
file = oiio.ImageInput.open(sys.argv[1])
if not file: sys.exit(oiio.geterror())
parts = []
while file.seek_subimage(len(parts), 0):
    spec = file.spec()
    pixels = file.read_image(len(parts), 0, 0, spec.nchannels, oiio.FLOAT).reshape(-1, spec.nchannels)
    texts = {a.name: list(a.value) if isinstance(a.value, tuple) else a.value if isinstance(a.value, (str, int, float)) else str(a.value) for a in spec.extra_attribs}
    formats = [str(f) for f in spec.channelformats] or [str(spec.format)] * spec.nchannels
    parts.append({"width": spec.width, "height": spec.height, "channels": list(spec.channelnames),
                  "formats": dict(zip(spec.channelnames, formats)), "texts": texts,
                  "values": {c: [float(v) for v in pixels[:, k]] for k, c in enumerate(spec.channelnames)}})
print(json.dumps(parts))
"""


def can_read():
    return subprocess.run([READER, "-c", "import OpenImageIO"], capture_output=True).returncode == 0


def read_parts(path):
    """A dictionary a part: width, height, channels, formats, texts, and values by channel from the top."""
    done = subprocess.run([READER, "-c", SCRIPT, str(path)], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def read(path):
    """The only part."""
    parts = read_parts(path)
    assert len(parts) == 1, len(parts)
    return parts[0]
