#!/usr/bin/env python3
"""scripts/docs_ir.py: writes docs/ir.md from the tables of the IR.

    scripts/docs_ir.py            # writes docs/ir.md
    scripts/docs_ir.py --check    # exits 1 if docs/ir.md is not what this would write

The operations come from jit/ir/ops.def, the passes from jit/passes/optimize.cpp (their order) and
jit/passes/passes.h (what they do). What is said about the structure of a kernel stands here.
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "ir.md"

HEAD = """# The IR

<!-- Written by scripts/docs_ir.py. Change the tables or the script, not this page. -->

A shader becomes a module of this representation, passes improve it, and a target encodes it. `jit/ir/ir.h` declares it, and `jit/ir/verify.cpp` checks all that a module promises. [From text to kernel](shaders.md) says where it stands in the compiler.

## A module

A module holds functions and the tables that they refer to: inputs, outputs, services, fault sites and constants. The first function is the kernel. It has no parameters, and its results are the module's outputs.

A function is one flat list of instructions in SSA form. An instruction gives at most one value, which is named by its index. Up to three operands are called a, b and c. `imm` and `imm2` are integers that belong to the instruction. Calls, returns and loops have a list of operands besides.

A value is defined before it is used. `If` and `EndIf` enclose a region, and so do `Loop` and `EndLoop`. A value defined inside is seen outside only through a `Merge` or a `LoopOut`.

Every meaning below holds for one lane, as if each lane ran alone. No result depends on which points share a group. Masks are ordinary values. Effects take the mask of the lanes that run them.

## The text form

`print` writes a module as text, and `parse_module` reads it back. `kinora-shade dump --stage ir` shows a shader's. Names of operations are in lower case. A result that may be of any type has its type behind a dot.

```
module "ramp" budget 1000000 slots 0
input "s" f point
output "Ci.r" f
function "kernel" () -> (f)
  %0 = constf 0.5
  %1 = input.f
  %2 = lt %1, %0
  if %2
    %4 = mul %1, %1
  endif #3
  %6 = merge.f %4, %1, #3
  return [%6]
end
```

## Types

| letter | type |
|---|---|
| F | a float, IEEE single precision |
| I | an integer of 32 bits, two's complement |
| M | a mask: true or false |
| T | F, I or M, the same throughout a row |

"""

FLAGS = {
    "kPure": ("pure", "may be moved, merged, removed, or run where its value is not needed"),
    "kCommutative": ("commutative", "a and b may be exchanged"),
    "kRead": ("reads", "pure, but reads memory that effects may change"),
    "kEffect": ("effect", "is kept, in order"),
    "kControl": ("control", "is the structure of the function"),
}
NAMES = {"operands": "FIMT*", "result": "FIMT0"}

OP = re.compile(r'OP\((\w+), "([^"]*)", (\w), ([\w |]+),\s*"((?:[^"\\]|\\.)*)"\)', re.S)


def fail(text):
    sys.exit(f"scripts/docs_ir.py: {text}")


def cell(text):
    for mark in "\\|<>*_":
        text = text.replace(mark, "\\" + mark)
    return text


def sections():
    """(comment, rows) of ops.def: a comment in front of rows begins a section."""
    text = (ROOT / "jit/ir/ops.def").read_text()
    text = text[text.index("\n\n"):]  # what explains the file
    found, at = [], 0
    for match in re.finditer(r"((?:^//[^\n]*\n)+)|" + OP.pattern, text, re.M | re.S):
        if text[at:match.start()].strip():
            fail(f"cannot read this of jit/ir/ops.def: {text[at:match.start()].strip()!r}")
        at = match.end()
        if match.group(1):
            comment = " ".join(line[2:].strip() for line in match.group(1).splitlines())
            found.append((comment, []))
        else:
            found[-1][1].append(match.groups()[1:])
    return found


def operations():
    lines = ["## Operations", "",
             "A row of `jit/ir/ops.def` is an operation. Its meaning is exact, and the same on every "
             "target. `*` stands for a list of operands of any length and type.", "",
             "| flag | meaning |", "|---|---|"]
    lines += [f"| {name} | {meaning} |" for name, meaning in FLAGS.values()]
    for comment, rows in sections():
        title = re.split(r"[.,;:(]", comment)[0].strip()
        lines += ["", f"### {title}", ""]
        rest = re.sub(r"^[^.,;:(]+[.,] ", "", comment) if comment.rstrip(".") != title else ""
        rest = rest if "::" in rest.split()[:1] else rest[:1].upper() + rest[1:]
        if rest:
            lines += [re.sub(r"(\w+::[\w:]+(?:\[\w+\])?)", r"`\1`", rest), ""]
        lines += ["| operation | operands | result | flags | meaning |", "|---|---|---|---|---|"]
        for name, operands, result, flags, meaning in rows:
            if set(operands) - set(NAMES["operands"]) or result not in NAMES["result"]:
                fail(f"{name} has a type that this script does not know")
            words = []
            for flag in flags.split("|"):
                if flag.strip() not in FLAGS:
                    fail(f"{name} has the flag {flag.strip()}, which this script does not know")
                words.append(FLAGS[flag.strip()][0])
            result = "" if result == "0" else result
            lines.append(f"| `{name}` | {cell(' '.join(operands))} | {result} | "
                         f"{', '.join(words)} | {cell(meaning)} |")
    return lines


def comments_of_passes():
    """What passes.h says of each pass, in front of it."""
    text = (ROOT / "jit/passes/passes.h").read_text()
    found, before = {}, []
    for line in text[text.index("namespace"):].splitlines():
        if match := re.match(r"\w+ (\w+)\(Module& module\);$", line):
            found[match.group(1)] = " ".join(before)
        before = before + [line[3:]] if line.startswith("// ") else []
    return found


def passes():
    """(stage, function) in the order in which optimize() runs them."""
    text = (ROOT / "jit/passes/optimize.cpp").read_text()
    tables = {name: re.findall(r'\{"(\w+)", (\w+)\}', rows)
              for name, rows in re.findall(r"constexpr Pass (\w+)\[\] = \{(.*?)\};", text, re.S)}
    body = text[text.index("void optimize("):]
    order = []
    for match in re.finditer(r'run_passes\(\*?\w+, (\w+), "([^"]*)"|\b(fuse|hoist)\(module\)', body):
        table, prefix, single = match.groups()
        rows = tables[table] if table else [(single, single)]
        order += [((prefix or "ir:") + name, function) for name, function in rows]
    return order


def pass_lines():
    what, order = comments_of_passes(), passes()
    for function in set(what) ^ {function for _, function in order}:
        fail(f"{function} is either not declared in passes.h or not run in optimize.cpp")
    lines = ["", "## Passes", "",
             "`jit::optimize` runs them in this order. `kinora-shade dump --stage NAME` shows the IR "
             "after one. `ir:frame:` is the frame kernel, which `hoist` splits off.", "",
             "| stage | file of `jit/passes` | what it does |", "|---|---|---|"]
    lines += [f"| `{stage}` | `{function}.cpp` | "
              f"{cell(what[function])} |" for stage, function in order]
    return lines


def page():
    return HEAD + "\n".join(operations() + pass_lines()) + "\n"


def main():
    text = page()
    if sys.argv[1:] == ["--check"]:
        if not PAGE.exists() or PAGE.read_text() != text:
            fail("docs/ir.md is not what the tables say; run scripts/docs_ir.py and commit the page")
        print("1 passed, 0 failed")
    elif not sys.argv[1:]:
        PAGE.write_text(text)
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
