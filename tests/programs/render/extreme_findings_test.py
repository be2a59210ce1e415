"""tests/programs/render/extreme_findings_test.py: cases of tests/promises whose outcome is a finding: code, severity and
place, as kinora-render tells them."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import ProgramTest, main, render
from written_scenes import (CAMERA, EYE, WHITE, animation, animations, camera, controllers, document, geometries, mesh,
                            one_joint_skin, place, rsl, source, square)

TRIANGLE = [0, 0, 0, 1, 0, 0, 0, 1, 0]
IDENTITY = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"
MOVED = place('<translate sid="t">0 0 0</translate>')


def scene(libraries, nodes=None, cam=(CAMERA, EYE), look=WHITE):
    return document(cam[0] + look + libraries, cam[1] + (nodes or place()))


def keyed(times, values, more=""):
    return scene(geometries(square()) + animations(animation("a", "node/t.X", times, values)).replace("</sampler>", more +
                 "</sampler>"), MOVED)


def skinned(change=("", ""), joints=True):
    skin = one_joint_skin("square", IDENTITY).replace(*change)
    joint = '<node id="j" sid="j" type="JOINT"/>'
    return scene(geometries(square()) + controllers(skin),
                 joint + place(url="#skin", kind="controller", skeleton="<skeleton>#j</skeleton>"))


def shaded(code):
    return scene(geometries(square()), look=rsl(code))


# Number of the case, the document, severity and code, and what stands on the line that the finding names.
CASES = ((3, scene(geometries(mesh("square", [0, 0, 0, 1e19, 0, 0, 0, 1, 0], [0, 1, 2]))), "warning", "", ""),)


class ExtremeFindings(ProgramTest):
    def test_code_place_and_severity(self):
        for number, text, severity, code, there in CASES:
            result = render(self.write("s.dae", text.replace("><", ">\n<")), "-o", "null", "--size", "8x8", "--spp", "1")
            print(number, result)


if __name__ == "__main__":
    main()
