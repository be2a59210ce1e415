#!/usr/bin/env python3
"""tests/programs/play/hour.py [SECONDS [TRIANGLES]]: kinora-play plays and orbits for so long (an hour); its
memory and its open files must not grow. Then a scene of so many triangles (ten million) is opened and left again;
in a window too, where Escape leaves it while it is read. For scripts/nightly."""
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import display as displays
import x_probe

SOURCE = Path(__file__).resolve().parents[3]
BIN = Path(os.environ.get("KINORA_BIN_DIR", SOURCE / "build/release/bin"))
SECONDS = float(sys.argv[1]) if len(sys.argv) > 1 else 3600
TRIANGLES = int(sys.argv[2]) if len(sys.argv) > 2 else 10_000_000
WALKER = SOURCE / "assets/scenes/walker.dae"
MATERIAL = "wall-material"


def lines(seconds):
    """What a restless person does, a second each."""
    yield "wait picture"
    yield "play on"
    for k in range(int(seconds)):
        yield f"orbit {(-1) ** (k // 40) * 3} {(-1) ** (k // 9) * 2}"
        yield ("dolly 1.02", "dolly 0.98", "next_key", "brighter", "darker", "click 300 180")[k % 6]
        if k % 5 == 0:
            yield f"select_material {MATERIAL}"
            yield f"param Kd {0.3 + 0.05 * (k // 5 % 9):.2f}"
        if k % 60 == 59:
            yield "open " + str(WALKER)
            yield "wait picture"
            yield "play on"
        yield "wait 1"
    yield "quit"


def megabytes(pid):
    return int(re.search(r"VmRSS:\s+(\d+)", Path(f"/proc/{pid}/status").read_text())[1]) / 1024


def play(folder):
    script = folder / "script.txt"
    script.write_text("\n".join(lines(SECONDS)) + "\n")
    process = subprocess.Popen([BIN / "kinora-play", WALKER, "--headless", "--real-time", "--script", script, "--size", "640x360"])
    start, rows = time.monotonic(), []
    while process.poll() is None:
        time.sleep(max(0.5, SECONDS / 240))
        try:
            rows.append((time.monotonic() - start, megabytes(process.pid), len(os.listdir(f"/proc/{process.pid}/fd"))))
        except (OSError, TypeError):
            break  # it has ended
    if process.wait() != 0:
        sys.exit(f"kinora-play ended with {process.returncode}")
    settled = [row for row in rows if row[0] > 0.3 * SECONDS]
    half = len(settled) // 2
    early, late = (sorted(row[1] for row in part) for part in (settled[:half], settled[half:]))
    print(f"memory, median: {early[len(early) // 2]:.1f} MB, then {late[len(late) // 2]:.1f} MB;",
          f"open files: {min(r[2] for r in settled)} to {max(r[2] for r in settled)}")
    if late[len(late) // 2] > 1.02 * early[len(early) // 2]:
        sys.exit("its memory grows")
    # One more for a moment: a file that is being read.
    files = [sorted(row[2] for row in part) for part in (settled[:half], settled[half:])]
    if files[1][half // 2] > files[0][half // 2]:
        sys.exit("its open files become more")


def many_triangles(folder):
    """A bumpy square of n x n cells as a document."""
    n = round((TRIANGLES / 2) ** 0.5)
    scene = folder / "many.dae"
    with open(scene, "w") as out:
        out.write('<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><created>2026-01-01T00:00:00</created>'
                  '<modified>2026-01-01T00:00:00</modified></asset><library_geometries><geometry id="g"><mesh><source id="p">'
                  f'<float_array id="a" count="{3 * (n + 1) ** 2}">')
        for y in range(n + 1):
            out.write(" ".join(f"{x} {(x * x + y * y) % 7} {y}" for x in range(n + 1)) + "\n")
        out.write(f'</float_array><technique_common><accessor source="#a" count="{(n + 1) ** 2}" stride="3"><param name="X" type="float"/>'
                  '<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>'
                  f'<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="{2 * n * n}">'
                  '<input semantic="VERTEX" source="#v" offset="0"/><p>')
        for y in range(n):
            row = y * (n + 1)
            out.write(" ".join(f"{a} {a + n + 1} {a + 1} {a + 1} {a + n + 1} {a + n + 2}" for a in range(row, row + n)) + "\n")
        out.write('</p></triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node id="n">'
                  '<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes><scene>'
                  '<instance_visual_scene url="#s"/></scene></COLLADA>')
    script = folder / "many.txt"
    script.write_text(f"wait picture\norbit 20 10\nscreenshot {folder}/many.png\nopen {WALKER}\nwait refined\n")
    start = time.monotonic()
    subprocess.run([BIN / "kinora-play", scene, "--headless", "--script", script, "--size", "160x90", "--quality", "preview"], check=True)
    print(f"{2 * n * n} triangles: {time.monotonic() - start:.1f} s")
    if not displays.missing() and not x_probe.missing():
        in_a_window(scene)


def in_a_window(scene):
    """The window comes first, says what it does, and Escape ends that."""
    with displays.Display(1280, 800) as display, x_probe.Hand(display) as hand:
        # The seconds of reading are told in the middle; the longer welcome reaches to its left.
        screen, middle, left = x_probe.Screen(display), (430, 300, 700, 450), (262, 300, 420, 450)
        window = displays.Window(display, BIN / "kinora-play", scene)
        print(f"its window after {1000 * (hand.until_mapped() - window.started):.0f} ms")
        window.appear()
        for _ in range(2):
            if not screen.until_changed(middle, screen.rows(middle), 10):
                sys.exit("nothing says that the scene is being read")
        before = screen.rows(left, 1)
        sent = hand.key("Escape")
        ended = screen.until(lambda: screen.rows(left, 1) != before)
        if not ended:
            sys.exit("Escape does not leave the scene")
        window.key("ctrl+q")
        if window.process.wait(60) != 0:
            sys.exit("it does not end after Escape")
        print(f"left {1000 * (ended - sent):.0f} ms after Escape")


with tempfile.TemporaryDirectory() as temporary:
    play(Path(temporary))
    many_triangles(Path(temporary))
