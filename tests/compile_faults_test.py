#!/usr/bin/env python3
"""tests/compile_faults_test.py: what must not compile does not, and the compiler names it.

Each case is a source with one fault planted, and the words that its message has. The same source
without the fault compiles.
"""
import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
COMPILER = os.environ.get("CXX", "c++")

ROW = """
#include "rsl/model/builtin.h"
using namespace kinora::rsl;
const Builtin kRows[] = {{"saturate", "SIGNATURES", nullptr, {}, kPure, 0, "x limited to 0..1."}};
"""
SERVICES = re.findall(r"^SERVICE\((\w+),", (ROOT / "rsl/model/services.def").read_text(), re.M)
OF_WORLD = ("texture", "environment", "shadow", "textureinfo", "transform")  # WorldHost answers
HOST = """
#include "runtime/scene/kernels/kernel_host.h"
namespace kinora {
struct Host : WorldHost {
    Host();
    TextureStore& textures() const override;
    dmat4 current_from_space(std::string_view name, size_t point) const override;
    dmat4 world_from_current() const override;
    ANSWERS
};
Host host;
}
"""
TABLE = """
#include "rsl/model/service_table.h"
using namespace kinora::rsl;
constexpr ServiceTable kTable = {ROWS};
"""


def row(signatures):
    return ROW.replace("SIGNATURES", signatures)


def host(without=None):
    answered = [s for s in SERVICES if s not in OF_WORLD and s != without]
    return HOST.replace("ANSWERS", "\n".join(f"KINORA_UNANSWERED({s})" for s in answered))


def table(without=None):
    answered = [s for s in SERVICES if s != without]
    return TABLE.replace("ROWS", ", ".join(f".{s} = answer_zeros<Service::{s}>" for s in answered))


RIGHT = {
    "a row": row("f=f c=c x=CsF[]? f=fff*~ m=~ f="),
    "a host": host(),
    "a table of services": table(),
}
WRONG = {  # case: (source, words of the message)
    "a row with a wrong letter": (row("f=f c=q"), ("saturate", "no_type_has_the_letter_q")),
    "a row with a wrong output": (row("x=Wf"), ("saturate", "no_type_has_the_letter_w")),
    "a row with a wrong result": (row("f=f y=f"), ("saturate", "no_type_has_the_letter_y")),
    "a row with a void argument": (row("f=x"), ("saturate", "x_as_an_argument")),
    "a row without a result": (row("ff"), ("saturate", "begins_with_a_result")),
    "a row with pairs in its middle": (row("f=f~f"), ("saturate", "before_its_end")),
    "a row that repeats nothing": (row("f=*"), ("saturate", "behind_no_argument")),
    "a host that forgets a service": (host("photons"), ("photons", "Host")),
    "a table that forgets a service": (table("photons"), ("ServiceFunction",)),
}


def message_of(source):
    """What the compiler says of it; "" where it compiles."""
    run = subprocess.run([COMPILER, "-std=c++20", "-fsyntax-only", "-I", ROOT, "-x", "c++", "-"], input=source,
                         capture_output=True, text=True)
    return run.stderr if run.returncode else ""


def cases():
    for name, source in RIGHT.items():
        message = message_of(source)
        yield f"{name} compiles", [message] if message else []
    for name, (source, words) in WRONG.items():
        message = message_of(source)
        missing = [word for word in words if word not in message]
        yield f"{name} does not compile", [f"no '{word}' in: {message or 'it compiles'}" for word in missing]


def main():
    failed = count = 0
    for name, faults in cases():
        print(f"{'FAILED' if faults else 'ok    '} {name}")
        for fault in faults:
            print(f"    {fault}")
        failed += bool(faults)
        count += 1
    print(f"{count - failed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
