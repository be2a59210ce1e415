"""tests/programs/play/x_probe.py: when things happen on an X display: events sent by XTest, the screen read as it is.

No process is started for an event, and a look at the screen takes microseconds: the times have neither in them."""
import ctypes
import ctypes.util
import mmap
import struct
import time
from ctypes import POINTER, Structure, Union, byref, c_char_p, c_int, c_long, c_uint, c_ulong, c_void_p

SUBSTRUCTURE_NOTIFY, MAP_NOTIFY = 1 << 19, 19


class _Map(Structure):
    _fields_ = [("type", c_int), ("serial", c_ulong), ("send_event", c_int), ("display", c_void_p), ("event", c_ulong),
                ("window", c_ulong), ("override_redirect", c_int)]


class _Event(Union):
    _fields_ = [("type", c_int), ("map", _Map), ("pad", c_long * 24)]


def missing():
    """The libraries it needs and does not find."""
    return [f"lib{name}" for name in ("X11", "Xtst") if not ctypes.util.find_library(name)]


class Screen:
    """What an Xvfb with -fbdir shows, without a copy of it."""

    def __init__(self, display):
        with open(display.folder / "Xvfb_screen0", "rb") as file:
            self.bytes = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        header = struct.unpack(">25I", self.bytes[:100])
        self.line, self.start = header[12], header[0] + 12 * header[19]

    def rows(self, box, step=7):
        """Bytes of every so-manieth row of a box (x0, y0, x1, y1)."""
        x0, y0, x1, y1 = box
        return b"".join(self.bytes[self.start + y * self.line + 4 * x0:self.start + y * self.line + 4 * x1] for y in range(y0, y1, step))

    def until(self, condition, seconds=30):
        """Waits until it holds; when that was (time.monotonic()), or none."""
        end = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > end:
                return None
            time.sleep(0.0005)
        return time.monotonic()

    def until_changed(self, box, before, seconds=30):
        return self.until(lambda: self.rows(box) != before, seconds)

    def until_still(self, box, quiet=0.4, seconds=60):
        """Its rows, once they have not changed for a while."""
        last, since, end = self.rows(box), time.monotonic(), time.monotonic() + seconds
        while time.monotonic() - since < quiet and time.monotonic() < end:
            time.sleep(0.02)
            now = self.rows(box)
            if now != last:
                last, since = now, time.monotonic()
        return last


class Hand:
    """Keys and a mouse. Each call returns when the server has taken the event, and says when it was sent."""

    def __init__(self, display):
        self.x, self.test = (ctypes.CDLL(ctypes.util.find_library(name)) for name in ("X11", "Xtst"))
        x = self.x
        x.XOpenDisplay.restype, x.XOpenDisplay.argtypes = c_void_p, [c_char_p]
        x.XDefaultRootWindow.restype, x.XDefaultRootWindow.argtypes = c_ulong, [c_void_p]
        x.XStringToKeysym.restype, x.XStringToKeysym.argtypes = c_ulong, [c_char_p]
        x.XKeysymToKeycode.restype, x.XKeysymToKeycode.argtypes = ctypes.c_ubyte, [c_void_p, c_ulong]
        x.XSelectInput.argtypes = [c_void_p, c_ulong, c_long]
        x.XNextEvent.argtypes = [c_void_p, POINTER(_Event)]
        x.XSync.argtypes = [c_void_p, c_int]
        for name in ("XPending", "XCloseDisplay"):
            getattr(x, name).argtypes = [c_void_p]
        self.test.XTestFakeKeyEvent.argtypes = [c_void_p, c_uint, c_int, c_ulong]
        self.test.XTestFakeButtonEvent.argtypes = [c_void_p, c_uint, c_int, c_ulong]
        self.test.XTestFakeMotionEvent.argtypes = [c_void_p, c_int, c_int, c_int, c_ulong]
        self.display = x.XOpenDisplay(display.name.encode())
        assert self.display, "no connection to " + display.name
        x.XSelectInput(self.display, x.XDefaultRootWindow(self.display), SUBSTRUCTURE_NOTIFY)
        x.XSync(self.display, 0)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.x.XCloseDisplay(self.display)

    def until_mapped(self, seconds=30):
        """When a window of the screen became visible, or none."""
        end, event = time.monotonic() + seconds, _Event()
        while time.monotonic() < end:
            while self.x.XPending(self.display):
                self.x.XNextEvent(self.display, byref(event))
                if event.type == MAP_NOTIFY:
                    return time.monotonic()
            time.sleep(0.0005)
        return None

    def key(self, name):
        code = self.x.XKeysymToKeycode(self.display, self.x.XStringToKeysym(name.encode()))
        sent = time.monotonic()
        for down in (1, 0):
            self.test.XTestFakeKeyEvent(self.display, code, down, 0)
        self.x.XSync(self.display, 0)
        return sent

    def move(self, x, y):
        sent = time.monotonic()
        self.test.XTestFakeMotionEvent(self.display, -1, x, y, 0)
        self.x.XSync(self.display, 0)
        return sent

    def button(self, number, down):
        sent = time.monotonic()
        self.test.XTestFakeButtonEvent(self.display, number, int(down), 0)
        self.x.XSync(self.display, 0)
        return sent
