"""tests/programs/play/display.py: a display without a screen (Xvfb), real keys and mouse (xdotool)."""
import os
import re
import shutil
import signal
import struct
import subprocess
import tempfile
import time
import zlib
from pathlib import Path


def missing():
    """Names of programs that are not installed; the tests are skipped then."""
    return [name for name in ("Xvfb", "xdotool") if not shutil.which(name)]


def png(path, width, height, rgb):
    """Writes bytes r g b as a .png."""
    rows = b"".join(b"\0" + rgb[3 * width * y:3 * width * (y + 1)] for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                           chunk(b"IDAT", zlib.compress(rows, 6)) + chunk(b"IEND", b""))


class Display:
    """One Xvfb, with a folder of its own for settings and pictures."""

    def __init__(self, width=1280, height=800):
        self.width, self.height = width, height
        self.folder = Path(tempfile.mkdtemp(prefix="kinora_display_"))
        read, write = os.pipe()
        # -r: a key does not repeat by itself where the processors are busy as it is pressed.
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{width}x{height}x24", "-fbdir", str(self.folder),
             "-nolisten", "tcp", "-noreset", "-r"], pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as numbers:
            self.name = ":" + numbers.readline().strip()
        self.environment = dict(os.environ, DISPLAY=self.name, SDL_VIDEODRIVER="x11",
                                XDG_CONFIG_HOME=str(self.folder / "config"))
        self.environment.pop("WAYLAND_DISPLAY", None)

    def close(self):
        self.server.terminate()
        self.server.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def xdotool(self, *words):
        done = subprocess.run(["xdotool", *map(str, words)], env=self.environment, capture_output=True, text=True, timeout=60)
        return done.stdout.strip()

    def rgb(self):
        """What the screen shows: width * height * 3 bytes."""
        data = (self.folder / "Xvfb_screen0").read_bytes()
        header = struct.unpack(">25I", data[:100])
        size, width, height, line, colors = header[0], header[4], header[5], header[12], header[19]
        start = size + 12 * colors
        out = bytearray(3 * width * height)
        for y in range(height):
            row = data[start + y * line:start + y * line + 4 * width]
            at = 3 * width * y
            out[at:at + 3 * width:3] = row[2::4]
            out[at + 1:at + 3 * width:3] = row[1::4]
            out[at + 2:at + 3 * width:3] = row[0::4]
        return bytes(out)

    def pixel(self, x, y):
        at = 3 * (y * self.width + x)
        return tuple(self.rgb()[at:at + 3])

    def save(self, path):
        png(path, self.width, self.height, self.rgb())


class Window:
    """kinora-play on a display."""

    def __init__(self, display, program, *words, **options):
        self.display = display
        self.started = time.monotonic()
        self.process = subprocess.Popen([str(program), *map(str, words)], env=display.environment,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)
        self.id = ""

    def appear(self, seconds=30):
        """Waits for the window; seconds since the start."""
        end = time.monotonic() + seconds
        while time.monotonic() < end and self.process.poll() is None:
            found = self.display.xdotool("search", "--onlyvisible", "--pid", self.process.pid)
            if found:
                self.id = found.split()[-1]
                self.display.xdotool("windowfocus", self.id)
                return time.monotonic() - self.started
            time.sleep(0.02)
        raise AssertionError("no window: " + (self.process.communicate(timeout=5)[1] if self.process.poll() is not None else "it still runs"))

    def recorded(self, record, pattern, count=1, seconds=60):
        """Waits until --record's file has so many lines that match; its text."""
        end = time.monotonic() + seconds
        while True:
            text = Path(record).read_text() if Path(record).exists() else ""
            if len(re.findall(pattern, text, re.M)) >= count:
                return text
            if self.process.poll() is not None:
                raise AssertionError(f"the window is gone with {self.process.returncode}: {self.process.stderr.read()}")
            if time.monotonic() > end:
                raise AssertionError(f"no line {pattern} in {seconds} s: {text[-2000:]}")
            time.sleep(0.01)

    def key(self, *names):
        self.display.xdotool("key", "--delay", 20, *names)

    def type(self, text):
        self.display.xdotool("type", "--delay", 15, text)

    def move(self, x, y):
        self.display.xdotool("mousemove", x, y)

    def click(self, x, y, button=1):
        self.display.xdotool("mousemove", x, y, "sleep", 0.05, "click", button)

    def drag(self, x0, y0, x1, y1, button=1, steps=8):
        words = ["mousemove", x0, y0, "sleep", 0.05, "mousedown", button]
        for i in range(1, steps + 1):
            words += ["mousemove", x0 + (x1 - x0) * i // steps, y0 + (y1 - y0) * i // steps, "sleep", 0.02]
        self.display.xdotool(*words, "mouseup", button)

    def wait_still(self, seconds=60, quiet=0.6):
        """Until the screen has not changed for a while. False after so many seconds."""
        end, last, since = time.monotonic() + seconds, None, time.monotonic()
        while time.monotonic() < end:
            now = zlib.crc32(self.display.rgb())
            if now != last:
                last, since = now, time.monotonic()
            elif time.monotonic() - since > quiet:
                return True
            time.sleep(0.1)
        return False

    def close(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
            try:
                self.process.wait(10)
            except subprocess.TimeoutExpired:
                self.process.kill()
        self.process.communicate()
