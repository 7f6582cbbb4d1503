#!/usr/bin/env python3
"""Designs that ask for properties become mixtures and settings, and what is out of reach is an error or the nearest.

    python3 tests/run_resolve.py build/dev/apps/ombre/ombre [NAME...]
"""
import json
import math

import program
from program import expect, near

MATERIALS = program.SOURCE / "materials" / "j750.json"
POLYJET = ["--materials", MATERIALS, "--printer", "j750"]
STRAP = 'attribute("modulus", "10 + 100*(z + 5)") cube(10);\n'  # 10 to 1010 MPa
BEYOND = 'attribute("modulus", "3000 + 100*z") cube(10);\n'     # 2500 to 3500 MPa
SOFT, STIFF = 0.383, 2850  # MPa, of agilus-vero-modulus


def share_of_stiff(modulus):
    return math.log(modulus / SOFT) / math.log(STIFF / SOFT)


def resolved(folder, *arguments, status=0):
    return next(e for e in folder.events("resolve", *arguments, status=status) if e["event"] == "resolved")


def slices_have_the_fractions(folder):
    """The share of droplets is the mean of what the modulus asks for, over z."""
    folder.write("strap.vcad", STRAP)
    folder.run("slice", "strap.vcad", "--materials", MATERIALS, "--voxel", "0.2", "-o", "out")
    job = json.loads(folder.read("out/job.json"))
    step, = job["resolved"]
    expect(step["from"] == ["modulus"] and step["to"] == "fractions", f"{step}")
    expect(step["calibration"] == "agilus-vero-modulus" and "10.3390/ma16083014" in step["citation"], f"{step}")
    near(step["reach"][0], SOFT, 1e-9, "the least modulus")
    counts = {m["name"]: m["voxels"] for m in job["totals"]["materials"] if m["name"] != "void"}
    steps = 1000
    wanted = sum(share_of_stiff(10 + 1000 * (n + 0.5) / steps) for n in range(steps)) / steps
    near(counts["VeroClear"] / sum(counts.values()), wanted, 0.005, "the share of VeroClear")


def out_of_reach_is_refused(folder):
    folder.write("beyond.vcad", BEYOND)
    arguments = ["slice", "beyond.vcad", "--materials", MATERIALS, "--voxel", "0.5", "-o", "out"]
    wrong = folder.run(*arguments, status=1).stderr
    # z = -1.25 is within reach, z = -0.75 is not: 9 + 1 layers... of 20 from -1.5 + 0.5 / 2 on.
    layers = sum(1 for n in range(20) if 3000 + 100 * (-5 + 0.5 * (n + 0.5)) > STIFF)
    for words in (f"modulus is out of reach at {layers * 400:,} voxels", "3475 MPa at (-4.75, -4.75, 4.75) mm",
                  "agilus-vero-modulus reaches is 2850 MPa", "--out-of-reach nearest"):
        expect(words in wrong, f"{words!r} is not in {wrong}")
    expect(not (folder.path / "out").exists(), "it wrote all the same")
    folder.run(*arguments, "--out-of-reach", "nearest")


def reports_of_intent(folder):
    folder.write("strap.vcad", STRAP)
    part, = resolved(folder, "strap.vcad", *POLYJET)["printers"]
    row, = part["intent"]
    expect(row["attribute"] == "modulus" and row["by"] == "agilus-vero-modulus", f"{row}")
    near(row["requested"], 510, 1, "the mean modulus")
    near(row["worst_miss"], 0, 1e-3, "the worst miss")
    expect(row["share_out_of_reach"] == 0 and part["is_within_reach"], f"{row}")
    folder.write("beyond.vcad", BEYOND)
    part, = resolved(folder, "beyond.vcad", *POLYJET, "--report", "page.html", status=3)["printers"]
    row, = part["intent"]
    near(row["share_out_of_reach"], 0.65, 0.01, "the share out of reach")  # from z = -1.5 on
    near(row["worst_miss"], STIFF - 3500, 10, "the worst miss")
    near(row["worst_at_mm"][2], 5, 0.1, "its place")
    near(row["mean_miss"], 0.65 * 325, 5, "the mean miss")  # from 0 to 650 over 65 % of the part
    page = folder.read("page.html")
    expect("out of reach at z" in page and "data:image/png" in page, "the page has no picture")
    folder.run("resolve", "beyond.vcad", *POLYJET, "--out-of-reach", "nearest")


def two_properties_choose_three_materials(folder):
    """Logarithms of moduli and densities mix by the fractions, so both properties give them."""
    three = {"inputs": [{"fraction": "VeroClear"}, {"fraction": "VeroPureWht"}], "rest": "Agilus30Clr"}
    calibration_of(folder, "moduli", {**three, "interpolant": "log-mixture", "constants": {"values": [1, 100, 10000]}})
    calibration_of(folder, "weights", {**three, "property": "density", "unit": "g/cm3", "interpolant": "mixture",
                                       "constants": {"values": [1, 1.5, 1.2]}})
    ways = ["--calibration", "moduli.json", "--calibration", "weights.json"]
    # 0.2 of VeroClear, 0.3 of VeroPureWht: 100^0.2 * 10000^0.3 = 10^1.6 MPa, and 0.5 + 0.3 + 0.36 g/cm3.
    folder.write("part.vcad", 'attribute("modulus", 10^1.6) attribute("density", 1.16) cube(10);')
    part, = resolved(folder, "part.vcad", *POLYJET, *ways)["printers"]
    step, = part["steps"]
    expect(step["from"] == ["modulus", "density"] and step["beside"]["calibration"] == "weights", f"{step}")
    rows = {row["attribute"]: row for row in part["intent"]}
    for name, value in (("modulus", 10 ** 1.6), ("density", 1.16)):
        near(rows[name]["given"], value, 1e-6, name)
        expect(rows[name]["share_out_of_reach"] == 0, f"{rows}")
    folder.run("slice", "part.vcad", "--materials", MATERIALS, *ways, "--voxel", "0.2", "-o", "out")
    counts = {m["name"]: m["voxels"] for m in json.loads(folder.read("out/job.json"))["totals"]["materials"] if m["name"] != "void"}
    for name, share in (("VeroClear", 0.2), ("VeroPureWht", 0.3), ("Agilus30Clr", 0.5)):
        near(counts[name] / sum(counts.values()), share, 0.005, f"the share of {name}")
    # Beside 1.2 g/cm3 moduli go from 100^0.4, 0.4 of VeroClear in Agilus, to 10,000.
    folder.write("beyond.vcad", 'attribute("modulus", 5) attribute("density", 1.2) cube(10);')
    beyond = ["slice", "beyond.vcad", "--materials", MATERIALS, *ways, "--voxel", "0.5", "-o", "beyond"]
    wrong = folder.run(*beyond, status=1).stderr
    for words in ("modulus and density are out of reach together at 8,000 voxels: they are 5 MPa and 1.2 g/cm3 at",
                  "beside this density modulus is 6.30957 to 10000 MPa by moduli and weights", "--out-of-reach nearest"):
        expect(words in wrong, f"{words!r} is not in {wrong}")
    folder.run(*beyond, "--out-of-reach", "nearest")
    part, = resolved(folder, "beyond.vcad", *POLYJET, *ways, status=3)["printers"]
    expect(all(row["share_out_of_reach"] == 1 for row in part["intent"]), f"{part}")
    said = folder.run("resolve", "part.vcad", *POLYJET, *ways).stdout
    expect("modulus and density to fractions of VeroClear, VeroPureWht, Agilus30Clr by moduli and weights" in said, said)


def mixtures_of_ones_own_are_judged(folder):
    """A design that names its materials is not resolved; the report says what its mixture is expected to give."""
    folder.write("mixed.vcad", 'attribute("modulus", 100) fgrade([0.5, 0.5], [VeroClear, Agilus30Clr]) cube(10);')
    part, = resolved(folder, "mixed.vcad", *POLYJET)["printers"]
    expect(part["steps"] == [], f"{part}")
    near(part["intent"][0]["given"], math.sqrt(SOFT * STIFF), 1e-6, "the modulus of half and half")
    said = folder.run("slice", "mixed.vcad", *POLYJET, "--dry-run").stderr
    expect("the design names materials, so modulus does not choose any" in said, said)
    folder.write("other.vcad", 'attribute("modulus", 100) fgrade([0.5, 0.5], [VeroBlack, SUP706]) cube(10);')
    part, = resolved(folder, "other.vcad", *POLYJET)["printers"]
    expect("given" not in part["intent"][0], "it judges a mixture with a material that it does not know")
    folder.write("giga.vcad", 'attribute("modulus", 1, unit="GPa") cube(10, "VeroBlack");')
    part, = resolved(folder, "giga.vcad", *POLYJET)["printers"]
    expect("given" not in part["intent"][0], "it compares values of different units")
    folder.write("black.vcad", 'attribute("modulus", 100) cube(10, "VeroBlack");')
    part, = resolved(folder, "black.vcad", *POLYJET)["printers"]
    near(part["intent"][0]["given"], STIFF, 1e-6, "the modulus of another Vero")
    wrong = folder.run("slice", "mixed.vcad", *POLYJET, "--calibration", "agilus-vero-modulus", "-o", "out", status=1)
    expect("the design names its materials itself" in wrong.stderr, wrong.stderr)


def processes_compare(folder):
    folder.write("strap.vcad", STRAP.replace("cube", 'attribute("temperature", "238 + 3*x") cube'))
    parts = resolved(folder, "strap.vcad", *POLYJET, "--printer", "fff-foaming-pla", "--printer", "generic")["printers"]
    expect([p["printer"] for p in parts] == ["j750", "fff-foaming-pla", "generic"], f"{parts}")
    expect([s["to"] for s in parts[0]["steps"]] == ["fractions"], f"{parts[0]}")
    expect([s["to"] for s in parts[1]["steps"]] == ["flow_rate"], f"{parts[1]}")
    rows = {row["attribute"]: row for row in parts[1]["intent"]}
    expect(rows["temperature"]["mean_miss"] == 0, f"{rows}")
    expect("given" not in rows["modulus"], "nothing predicts the modulus of a foam")
    text = folder.run("resolve", "strap.vcad", *POLYJET, "--printer", "fff-foaming-pla").stdout
    expect("modulus to fractions by agilus-vero-modulus" in text and "doi:10.3390/ma16083014" in text, text)


def calibration_of(folder, name, members):
    about = {"title": name, "unit": "MPa", "property": "modulus", "citation": "made up for a test", "licence": "free"}
    folder.write(f"{name}.json", {"name": name, **about, **members})


def printer_of(folder, name, members):
    about = {"title": name, "source": "made up for a test", "pitch": {"x": "0.2", "y": "0.2", "z": "0.25"}, "image": "gray"}
    folder.write(f"{name}-printer.json", {"name": name, **about, **members})


def five_processes(folder):
    """One part with two properties on five machines; what each gives is known by hand."""
    mixture = {"inputs": [{"fraction": "VeroClear"}], "rest": "Agilus30Clr", "interpolant": "mixture"}
    calibration_of(folder, "droplets", {**mixture, "constants": {"values": [50, 250]}, "sd": 5})
    calibration_of(folder, "weights", {**mixture, "property": "density", "unit": "g/cm3", "constants": {"values": [1.0, 1.4]}})
    calibration_of(folder, "thirds", {"inputs": [{"attribute": "intensity", "unit": "1"}], "interpolant": "linear", "points": [
        {"inputs": [0], "value": 0, "sd": 0}, {"inputs": [1], "value": 300, "sd": 30}]})
    calibration_of(folder, "weak", {"inputs": [{"attribute": "infill_density", "unit": "%"}], "interpolant": "linear",
                                    "points": [{"inputs": [20], "value": 30}, {"inputs": [100], "value": 150}]})
    calibration_of(folder, "layers", {**mixture, "constants": {"values": [0, 400]}})
    # Paths of calibrations begin in the profile's folder.
    printer_of(folder, "ink", {"calibrations": ["./droplets.json", "./weights.json"]})
    printer_of(folder, "dose", {"needs": ["intensity"], "steps": {"intensity": 0.1}, "calibrations": ["./thirds.json"]})
    printer_of(folder, "infill", {"needs": ["infill_density"], "calibrations": ["./weak.json"]})
    printer_of(folder, "mixed", {"steps": {"fractions": 0.25}, "calibrations": ["./layers.json"]})
    folder.write("part.vcad", 'attribute("density", 1.2) attribute("modulus", "100 + 10*(z + 5)") cube(10);')
    names = ["./ink-printer.json", "./dose-printer.json", "./infill-printer.json", "./mixed-printer.json", "fff-foaming-pla"]
    arguments = ["part.vcad", "--materials", MATERIALS, "--deciding", "modulus"]
    for name in names:
        arguments += ["--printer", name]
    parts = resolved(folder, *arguments, "--report", "page.html", status=3)["printers"]
    row = {(part["printer"], intent["attribute"]): intent for part in parts for intent in part.get("intent", [])}

    moduli = [100 + 2.5 * (n + 0.5) for n in range(40)]  # of layers of 0.25 mm
    mean = lambda values: sum(values) / len(values)
    ink, weight = row["ink", "modulus"], row["ink", "density"]
    near(ink["mean_miss"], 0, 1e-4, "droplets")
    near(ink["expected_sd"], 5, 1e-9, "the spread of droplets")
    near(weight["given"], 1.2, 1e-6, "the mean density of droplets")
    near(weight["mean_miss"], mean([abs(0.4 * ((m - 50) / 200 - 0.5)) for m in moduli]), 1e-6, "their density")
    near(abs(weight["worst_miss"]), 0.0975, 1e-6, "the worst density")
    dose = row["dose", "modulus"]
    near(dose["mean_miss"], mean([abs(30 * round(m / 30) - m) for m in moduli]), 1e-4, "steps of light")
    near(abs(dose["worst_miss"]), max(abs(30 * round(m / 30) - m) for m in moduli), 1e-4, "the worst step")
    near(dose["expected_sd"], mean([30 * 0.1 * round(m / 30) for m in moduli]), 1e-4, "the spread of light")
    infill = row["infill", "modulus"]
    expect(infill["share_out_of_reach"] == 0.5, f"{infill}")
    near(infill["mean_miss"], mean([max(0, m - 150) for m in moduli]), 1e-4, "what is too weak")
    near(infill["worst_miss"], 150 - moduli[-1], 1e-4, "the weakest")
    near(infill["worst_at_mm"][2], 4.875, 1e-9, "its place")
    mixed = row["mixed", "modulus"]
    near(mixed["mean_miss"], mean([min(m - 100, 200 - m) for m in moduli]), 1e-4, "quarters")
    near(abs(mixed["worst_miss"]), 48.75, 1e-4, "the worst quarter")
    expect(mixed["share_out_of_reach"] == 0, f"{mixed}")
    for printer in ("dose", "infill", "mixed"):
        expect("given" not in row[printer, "density"], f"{printer} knows no density")
    expect("no calibration leads from there to temperature" in parts[4]["problem"], f"{parts[4]}")
    page = folder.read("page.html")
    expect(page.count("<tr") >= 1 + 9 and "multiples of 0.25" in page, "the page lacks rows")
    text = folder.run("resolve", *arguments, status=3).stdout
    for words in ("modulus to intensity by thirds", "the machine takes multiples of 0.1, to which intensity is rounded",
                  "unknown", "50 %"):
        expect(words in text, f"{words!r} is not in {text}")


def shipped_processes(folder):
    """The example of the page on properties."""
    grip = program.SOURCE / "examples" / "tuned_grip.vcad"
    arguments = [grip, "--materials", program.SOURCE / "materials" / "processes.json", "--deciding", "modulus"]
    for name in ("j750", "vat-two-resins", "fff-infill", "fff-two-filaments", "fff-foaming-pla"):
        arguments += ["--printer", name]
    parts = resolved(folder, *arguments, status=3)["printers"]
    reached = {part["printer"]: part["intent"] for part in parts if "intent" in part}
    by_name = {(printer, row["attribute"]): row for printer, rows in reached.items() for row in rows}
    near(by_name["j750", "modulus"]["share_out_of_reach"], 0, 1e-12, "droplets reach 50 to 2000 MPa")
    # 2000 * (50 / 2000)^depth is above 1600 up to a depth of 0.0605, between 8 and 8.42 mm; grooves take some of the rest.
    expect(by_name["vat-two-resins", "modulus"]["share_out_of_reach"] > 0.9, "two resins are both stiff")
    near(by_name["fff-infill", "modulus"]["share_out_of_reach"], 0, 1e-12, "infills reach 9 to 3600 MPa")
    expect(abs(by_name["fff-two-filaments", "modulus"]["worst_miss"]) > 400, "quarters of 3588 MPa are coarse")


def slices_take_what_decides(folder):
    folder.write("both.vcad", STRAP.replace("cube", 'attribute("density", 1.15) cube'))
    arguments = ["slice", "both.vcad", "--materials", MATERIALS, "--voxel", "0.5"]
    wrong = " ".join(folder.run(*arguments, "-o", "out", status=1).stderr.split())
    expect("they contradict each other: at (" in wrong and "--deciding" in wrong, wrong)
    folder.run(*arguments, "--deciding", "modulus", "-o", "out")
    folder.write("strap.vcad", STRAP)
    folder.run("slice", "strap.vcad", *arguments[2:], "-o", "one")
    for path in sorted((folder.path / "one").glob("*.png")):
        expect(path.read_bytes() == (folder.path / "out" / path.name).read_bytes(), f"{path.name} differs")


def what_remains_is_left_to_the_next_process(folder):
    """A design with a modulus and a temperature is resolved for one machine, then for another one."""
    folder.write("two.vcad", STRAP.replace("cube", 'attribute("temperature", 238) cube'))
    folder.run("resolve", "two.vcad", *POLYJET, "-o", "mixed.json")
    folder.run("resolve", "mixed.json", "--printer", "fff-foaming-pla", "-o", "hot.json")
    point, = folder.events("probe", "hot.json", "--at", "0,0,0")
    near(point["attributes"]["flow_rate"], 1.04, 1e-9, "the flow")
    near(point["attributes"]["modulus"], 510, 1e-9, "the modulus")
    near(point["composition"]["VeroClear"], share_of_stiff(510), 1e-6, "the share of VeroClear")
    folder.write("cold.vcad", STRAP)
    wrong = folder.run("resolve", "cold.vcad", "--printer", "fff-foaming-pla", status=1).stderr
    expect("no calibration leads from there to temperature" in wrong and "it could give flow_rate" in wrong, wrong)


def resolved_designs_are_designs(folder):
    folder.write("hot.vcad", 'attribute("temperature", "238 + 3*x") cube(10);')
    folder.run("resolve", "hot.vcad", "--printer", "fff-foaming-pla", "-o", "resolved.json")
    point, = folder.events("probe", "resolved.json", "--at", "2,0,0")
    near(point["attributes"]["flow_rate"], 1.42 + (1.42 - 0.66) / (220 - 256) * (244 - 220), 1e-9, "the flow")
    folder.write("strap.vcad", STRAP)
    folder.run("resolve", "strap.vcad", *POLYJET, "-o", "strap.json")
    folder.run("slice", "strap.json", "--voxel", "0.5", "-o", "written")
    folder.run("slice", "strap.vcad", "--materials", MATERIALS, "--voxel", "0.5", "-o", "direct")
    for name in sorted(path.name for path in (folder.path / "direct").glob("*.png")):
        one, other = (folder.path / out / name for out in ("written", "direct"))
        expect(one.read_bytes() == other.read_bytes(), f"{name} differs")
    folder.run("verify", "direct", "--design", "strap.json")
    wrong = folder.run("slice", "hot.vcad", "--printer", "fff-foaming-pla", "-o", "out", status=1).stderr
    expect("takes temperature and flow_rate, not layers of materials" in wrong, wrong)


def resolved_designs_find_their_files(folder):
    folder.write_design_of_files('attribute("temperature", "238 + 3*z") ')
    (folder.path / "other").mkdir()
    for place, name in (("sub", "corner.off"), ("other", "../sub/corner.off")):
        folder.run("resolve", "sub/part.vcad", "--printer", "fff-foaming-pla", "-o", f"{place}/resolved.json")
        expect(f'"{name}"' in folder.read(f"{place}/resolved.json"), place)
        result = program.run([folder.ombre, "probe", "resolved.json", "--at", "1,1,1", "--json"], cwd=folder.path / place)
        expect(json.loads(result.stdout)["inside"], result.stderr)


def values_are_resolved_too(folder):
    """Layers that show an attribute which the design does not give itself."""
    folder.write("hot.vcad", 'attribute("temperature", "238 + 3*x") cube(10);')
    folder.run("layer", "hot.vcad", "--by", "flow_rate", "--calibration", "foaming-pla-flow", "--z", "0", "-o", "flow.png")


def a_job_without_a_calibration_says_so(folder):
    folder.write("strap.vcad", STRAP)
    said = folder.run("slice", "strap.vcad", "--voxel", "0.5", "-o", "plain").stderr
    expect("modulus does not choose materials, since the job has no calibration" in said, said)
    folder.write("named.vcad", 'attribute("modulus", 5) cube(10, "blue");')
    said = folder.run("slice", "named.vcad", "--voxel", "0.5", "-o", "named").stderr
    expect("calibration" not in said, said)


def wrong_words(folder):
    folder.write("strap.vcad", STRAP)
    folder.write("both.vcad", STRAP.replace("cube", 'attribute("density", 1.15) cube'))
    folder.write("broken.json", {"name": "broken", "tittle": "t"})
    for arguments, words in [
            (["strap.vcad", *POLYJET, "--calibration", "agilus-vero-modulos"], 'did you mean "agilus-vero-modulus"?'),
            (["strap.vcad", *POLYJET, "--calibration", "broken.json"], 'did you mean "title"?'),
            (["strap.vcad", *POLYJET, "--calibration", "foaming-pla-flow"],
             "the design gives modulus, and no calibration leads from there to fractions"),
            (["both.vcad", *POLYJET],
             "two chains of calibrations lead to fractions: modulus to fractions by agilus-vero-modulus; and density to "
             "fractions by agilus-vero-density"),
            (["strap.vcad", "--printer", "j750", "--calibration", "agilus-vero-modulus"],
             "agilus-vero-modulus needs the material VeroClear or another one of its list, which the materials file lacks")]:
        wrong = folder.run("resolve", *arguments, status=1).stderr
        expect(words in " ".join(wrong.split()), f"{arguments}: {wrong}")


CHECKS = program.named((slices_have_the_fractions, out_of_reach_is_refused, reports_of_intent,
                        two_properties_choose_three_materials, mixtures_of_ones_own_are_judged, processes_compare, five_processes, shipped_processes,
                        slices_take_what_decides, what_remains_is_left_to_the_next_process, resolved_designs_are_designs,
                        resolved_designs_find_their_files,
                        values_are_resolved_too, a_job_without_a_calibration_says_so, wrong_words))

if __name__ == "__main__":
    raise SystemExit(program.main(program.Folder, CHECKS))
