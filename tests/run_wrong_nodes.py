#!/usr/bin/env python3
"""Nodes that are declared wrongly do not compile, and one that is right does.

    python3 tests/run_wrong_nodes.py COMPILER
"""
import concurrent.futures
import pathlib
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent / "src"

NODE = """#include "design/spec.h"
using namespace ombre;
using namespace ombre::design;
struct Wave {{
  Number size = 1;
  static Spec<Wave> spec() {{
    return {{"wave", "A wave.", {{{{"size", {parameter}, "Its size"}}}}, no_inputs, "", {{{{"value", {output}, "It"}}}}}};
  }}
  {method} {{ return {result}; }}
}};
void add(Registry& registry) {{ registry.add<Wave>("values"); }}
"""
RIGHT = {"parameter": "&Wave::size", "output": "&Wave::value", "method": "Field value(const Ask& ask) const",
         "result": "size(ask.p)"}

AN_OUTPUT = "an output is a method that takes a const Ask&"
# What is wrong, what the declaration has instead, and a word of the compiler's message.
WRONG = [
    ("a number that is no field", {"method": "double value(const Ask&) const", "result": "1"}, AN_OUTPUT),
    ("an output that is evaluated with a point alone", {"method": "Field value(const Point& p) const", "result": "size(p)"},
     AN_OUTPUT),
    ("an output that changes its node", {"method": "Field value(const Ask& ask)"}, AN_OUTPUT),
    ("an output that is misspelt", {"output": "&Wave::vlaue"}, "vlaue"),
    ("a method as a parameter", {"parameter": "&Wave::value"}, "a parameter is a member, not a method"),
]

SOLID = """#include "design/spec.h"
using namespace ombre;
using namespace ombre::design;
namespace {{
struct Ball {{
  Number radius = 1;
  static Spec<Ball> spec() {{
    return {{"ball", "A ball.", {{{{"radius", &Ball::radius, "Its radius"}}}}, no_inputs, ""}};
  }}
  Field distance(const Point& p) const {{ return length(p.x, p.y, p.z) - radius(p); }}
  {method}
}};
}}
void add(Registry& registry) {{ registry.add<Ball>("solids"); }}
"""
# Clang alone tells of methods that nothing calls, since their name is none of a node's.
MISSPELT = "Field membrship(const Inputs&, const Point& p, Border) const { return p.x; }"
WRONG_METHODS = [
    ("Box bounds() const { return Box(); }", "bounds is Box bounds(const Box& where) const"),
    ("Field membership(const Inputs&, const Point& p) const { return p.x; }", "membership is Field membership(const Inputs&"),
    ("Traits traits(const Point&) const { return {}; }", "traits is Traits traits() const"),
    ("Composition composition(const Inputs&, const Point&) const { return {}; }", "composition is Composition"),
]


def compile_text(compiler, folder, number, text):
    file = pathlib.Path(folder) / f"node{number}.cpp"
    file.write_text(text)
    warnings = ["-Werror", "-Wunused-member-function"] if "clang" in compiler else []
    return subprocess.run([compiler, "-std=c++20", "-fsyntax-only", *warnings, f"-I{SOURCE}", file], capture_output=True,
                          text=True)


def main():
    compiler = sys.argv[1]
    cases = [("a right node", NODE.format(**RIGHT), None), ("a right solid", SOLID.format(method=""), None)]
    cases += [(what, NODE.format(**{**RIGHT, **changes}), message) for what, changes, message in WRONG]
    cases += [(method, SOLID.format(method=method), message) for method, message in WRONG_METHODS]
    if "clang" in compiler:
        cases.append((MISSPELT, SOLID.format(method=MISSPELT), "unused member function 'membrship'"))
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(2) as pool:
        results = list(pool.map(lambda n: compile_text(compiler, folder, n, cases[n][1]), range(len(cases))))
    failures = 0
    for (what, _, message), result in zip(cases, results):
        is_good = result.returncode == 0 if message is None else result.returncode != 0 and message in result.stderr
        failures += not is_good
        if not is_good:
            print(f"FAILED {what}\n{result.stderr or 'it compiles'}")
    print(f"{len(cases) - failures} of {len(cases)} are as expected")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
