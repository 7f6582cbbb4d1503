"""The command line, which runs designs that are Python scripts: python3 -m ombre slice part.py."""
import contextlib
import json
import os
import sys
import traceback


def _definitions(texts):
    variables = {}
    for text in texts:
        name, _, value = text.partition("=")
        try:
            variables[name.strip()] = json.loads(value)
        except ValueError:
            variables[name.strip()] = value
    return variables


def _load(path, materials, definitions):
    """Loads the design for the compiled part; returns None once the mistakes have been reported. What the script prints
    goes to stderr, since stdout may hold what the command makes: `--emit json`."""
    from ._errors import DesignError
    from ._script import load_script
    try:
        with contextlib.redirect_stdout(sys.stderr):
            return load_script(path, materials, _definitions(definitions))
    except DesignError as error:
        print(error, file=sys.stderr)
    except SystemExit as end:
        print(f"{path} ended with sys.exit({end.code!r})", file=sys.stderr)
    except BaseException:  # also exceptions by which scripts end themselves
        kind, error, trace = sys.exc_info()
        while trace and trace.tb_frame.f_code.co_filename != path:  # frames of Ombre itself
            trace = trace.tb_next
        traceback.print_exception(kind, error, trace)
    return None


def _run_arguments(arguments):
    """`run script.py [-- [COMMAND] ARGS]`: the arguments of the command that gets the script as its design."""
    if not arguments or arguments[0] in ("-h", "--help"):
        print("Usage: ombre run SCRIPT.py [-- [COMMAND] ARGUMENTS...]\n\n"
              "Runs a script. With --, its root becomes the design of a command; where none is named, the ending of\n"
              "-o says which: .png a picture, .stl .3mf ... a mesh, .vdb .npy ... voxels, .svg .cli contours, a folder\n"
              "slices.\n\nExamples:\n  ombre run part.py\n  ombre run part.py -- -o part.3mf\n"
              "  ombre run part.py -- slice --printer j750 -o layers/")
        return None
    script, rest = arguments[0], arguments[1:]
    if not rest:
        return [script]
    if rest[0] != "--":
        print(f"ombre: error: write -- before {rest[0]}: ombre run {script} -- {' '.join(rest)}", file=sys.stderr)
        raise SystemExit(1)
    rest = rest[1:]
    if rest and not rest[0].startswith("-"):
        return [rest[0], script, *rest[1:]]
    output = next((b for a, b in zip(rest, rest[1:]) if a in ("-o", "--output")), "")
    from ._commands import kind_for
    return [kind_for(output) or "slice", script, *rest]


def main(arguments=None):
    from . import _core
    arguments = list(sys.argv[1:] if arguments is None else arguments)
    makes_share = any(word.endswith(".json") for word in arguments[1:])  # ombre run plan.json
    if arguments[:1] == ["run"] and not makes_share:
        arguments = _run_arguments(arguments[1:])
        if arguments is None:
            return 0
        if len(arguments) == 1:
            import runpy
            sys.argv = arguments
            from ._script import folders_of
            sys.path[:0] = folders_of(arguments[0])
            runpy.run_path(arguments[0], run_name="__main__")
            return 0
    from ._errors import FunctionError
    try:
        return _core.run_main(arguments, _load)
    except FunctionError as error:
        traceback.print_exception(error.__cause__)
        print(f"ombre: error: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
