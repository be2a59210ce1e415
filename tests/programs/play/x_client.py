"""tests/programs/play/x_client.py: another program on the same X display, by libX11 alone: it offers a text on the
clipboard, reads that of others, and drops files on a window (XDND, https://freedesktop.org/wiki/Specifications/XDND)."""
import ctypes
import ctypes.util
import select
import threading
import time
from ctypes import POINTER, Structure, Union, byref, c_char_p, c_int, c_long, c_ubyte, c_ulong, c_void_p
from urllib.parse import quote


class _Client(Structure):
    _fields_ = [("type", c_int), ("serial", c_ulong), ("send_event", c_int), ("display", c_void_p), ("window", c_ulong),
                ("message_type", c_ulong), ("format", c_int), ("data", c_long * 5)]


class _Request(Structure):
    _fields_ = [("type", c_int), ("serial", c_ulong), ("send_event", c_int), ("display", c_void_p), ("owner", c_ulong),
                ("requestor", c_ulong), ("selection", c_ulong), ("target", c_ulong), ("property", c_ulong), ("time", c_ulong)]


class _Notify(Structure):
    _fields_ = [("type", c_int), ("serial", c_ulong), ("send_event", c_int), ("display", c_void_p), ("requestor", c_ulong),
                ("selection", c_ulong), ("target", c_ulong), ("property", c_ulong), ("time", c_ulong)]


class _Event(Union):
    _fields_ = [("type", c_int), ("client", _Client), ("request", _Request), ("notify", _Notify), ("pad", c_long * 24)]


SELECTION_REQUEST, SELECTION_NOTIFY, CLIENT_MESSAGE = 30, 31, 33
XA_ATOM, XDND_VERSION = 4, 5


def _library():
    x = ctypes.CDLL(ctypes.util.find_library("X11"))
    x.XOpenDisplay.restype, x.XOpenDisplay.argtypes = c_void_p, [c_char_p]
    x.XDefaultRootWindow.restype, x.XDefaultRootWindow.argtypes = c_ulong, [c_void_p]
    x.XCreateSimpleWindow.restype = c_ulong
    x.XCreateSimpleWindow.argtypes = [c_void_p, c_ulong, c_int, c_int, c_int, c_int, c_int, c_ulong, c_ulong]
    x.XInternAtom.restype, x.XInternAtom.argtypes = c_ulong, [c_void_p, c_char_p, c_int]
    x.XSetSelectionOwner.argtypes = [c_void_p, c_ulong, c_ulong, c_ulong]
    x.XConvertSelection.argtypes = [c_void_p, c_ulong, c_ulong, c_ulong, c_ulong, c_ulong]
    x.XChangeProperty.argtypes = [c_void_p, c_ulong, c_ulong, c_ulong, c_int, c_int, c_void_p, c_int]
    x.XGetWindowProperty.argtypes = [c_void_p, c_ulong, c_ulong, c_long, c_long, c_int, c_ulong, POINTER(c_ulong), POINTER(c_int),
                                     POINTER(c_ulong), POINTER(c_ulong), POINTER(POINTER(c_ubyte))]
    x.XSendEvent.argtypes = [c_void_p, c_ulong, c_int, c_long, POINTER(_Event)]
    x.XNextEvent.argtypes = [c_void_p, POINTER(_Event)]
    for name in ("XPending", "XFlush", "XConnectionNumber", "XCloseDisplay"):
        getattr(x, name).argtypes = [c_void_p]
    x.XFree.argtypes = [c_void_p]
    return x


class Client:
    """One connection, served by a thread of its own."""

    def __init__(self, display):
        self.x = _library()
        self.display = self.x.XOpenDisplay(display.name.encode())
        assert self.display, "no connection to " + display.name
        self.window = self.x.XCreateSimpleWindow(self.display, self.x.XDefaultRootWindow(self.display), 0, 0, 1, 1, 0, 0, 0)
        self.offers, self.received, self.messages = {}, None, []
        self.lock, self.ends = threading.RLock(), False
        self.thread = threading.Thread(target=self._serve, daemon=True)
        self.thread.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.ends = True
        self.thread.join()
        self.x.XCloseDisplay(self.display)

    def atom(self, name):
        return self.x.XInternAtom(self.display, name.encode(), 0)

    def _serve(self):
        while not self.ends:
            with self.lock:
                while self.x.XPending(self.display):
                    event = _Event()
                    self.x.XNextEvent(self.display, byref(event))
                    self._take(event)
            select.select([self.x.XConnectionNumber(self.display)], [], [], 0.02)

    def _take(self, event):
        if event.type == SELECTION_REQUEST:
            self._answer(event.request)
        elif event.type == SELECTION_NOTIFY:
            self.received = self._property(event.notify.property) if event.notify.property else b""
        elif event.type == CLIENT_MESSAGE:
            self.messages.append((event.client.message_type, list(event.client.data)))

    def _answer(self, request):
        offered = self.offers.get(request.selection, {})
        answer = _Event()
        answer.notify = _Notify(SELECTION_NOTIFY, 0, 1, self.display, request.requestor, request.selection, request.target, 0, request.time)
        if request.target == self.atom("TARGETS"):
            atoms = (c_long * (len(offered) + 1))(request.target, *offered)
            self.x.XChangeProperty(self.display, request.requestor, request.property, XA_ATOM, 32, 0, atoms, len(atoms))
            answer.notify.property = request.property
        elif request.target in offered:
            data = offered[request.target]
            self.x.XChangeProperty(self.display, request.requestor, request.property, request.target, 8, 0, data, len(data))
            answer.notify.property = request.property
        self.x.XSendEvent(self.display, request.requestor, 0, 0, byref(answer))
        self.x.XFlush(self.display)

    def _property(self, name):
        kind, form, count, rest, data = c_ulong(), c_int(), c_ulong(), c_ulong(), POINTER(c_ubyte)()
        self.x.XGetWindowProperty(self.display, self.window, name, 0, 1 << 20, 1, 0, byref(kind), byref(form), byref(count), byref(rest),
                                  byref(data))
        out = bytes(data[:count.value]) if data else b""
        if data:
            self.x.XFree(data)
        return out

    def _until(self, condition, seconds=30):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            with self.lock:
                if condition():
                    return
            time.sleep(0.02)
        raise AssertionError("the window does not answer")

    def copy(self, text):
        """Offers a text on the clipboard from now on."""
        with self.lock:
            clipboard = self.atom("CLIPBOARD")
            self.offers[clipboard] = {self.atom(kind): text.encode() for kind in ("UTF8_STRING", "text/plain;charset=utf-8")}
            self.x.XSetSelectionOwner(self.display, clipboard, self.window, 0)
            self.x.XFlush(self.display)

    def paste(self):
        """The text that another program offers."""
        with self.lock:
            self.received = None
            self.x.XConvertSelection(self.display, self.atom("CLIPBOARD"), self.atom("UTF8_STRING"), self.atom("KINORA_PASTE"), self.window, 0)
            self.x.XFlush(self.display)
        self._until(lambda: self.received is not None)
        return self.received.decode()

    def _send(self, target, kind, *data):
        event = _Event()
        event.client = _Client(CLIENT_MESSAGE, 0, 1, self.display, target, self.atom(kind), 32, (c_long * 5)(*data))
        self.x.XSendEvent(self.display, target, 0, 0, byref(event))
        self.x.XFlush(self.display)

    def _answered(self, kind):
        wanted = self.atom(kind)
        self._until(lambda: any(message == wanted for message, _ in self.messages))

    def drop(self, target, x, y, files):
        """Drags files over a window of that number and lets them go there."""
        target = int(target)
        with self.lock:
            self.messages.clear()
            selection, uris = self.atom("XdndSelection"), self.atom("text/uri-list")
            self.offers[selection] = {uris: "".join(f"file://{quote(str(file))}\r\n" for file in files).encode()}
            self.x.XSetSelectionOwner(self.display, selection, self.window, 0)
            self._send(target, "XdndEnter", self.window, XDND_VERSION << 24, uris, 0, 0)
            self._send(target, "XdndPosition", self.window, 0, x << 16 | y, 0, self.atom("XdndActionCopy"))
        self._answered("XdndStatus")
        with self.lock:
            self._send(target, "XdndDrop", self.window, 0, 0, 0, 0)
        self._answered("XdndFinished")
