#include "jobs/submit_scripts.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "base/text/json.h"

namespace ombre::jobs {
namespace {

namespace fs = std::filesystem;

struct Place {
  std::string_view name;
  std::string value;
};

// Replaces each {name} by its value. Texts that are inserted are not searched again.
std::string filled(std::string_view text, const std::vector<Place>& places) {
  std::string made;
  for (size_t at = 0; at < text.size();) {
    const auto place = std::ranges::find_if(places, [&](const Place& p) {
      return text[at] == '{' && text.substr(at + 1).starts_with(p.name) &&
             text.substr(at + 1 + p.name.size()).starts_with('}');
    });
    made += place == places.end() ? std::string(1, text[at]) : place->value;
    at += place == places.end() ? 1 : place->name.size() + 2;
  }
  return made;
}

// Names in engines have small letters, digits and dashes, and are short.
std::string engine_name(const std::string& plan) {
  constexpr size_t longest = 40;
  std::string name = "ombre-";
  for (const char c : fs::path(plan).stem().string()) {
    const bool is_kept = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (is_kept) name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (!is_kept && name.back() != '-') name += '-';
  }
  name.resize(std::min(name.size(), longest));
  while (name.back() == '-') name.pop_back();
  return name;
}

std::vector<Place> places_of(const Submission& s) {
  const auto text = [](int64_t number) { return std::to_string(number); };
  return {{"plan", shell_word(s.plan)},
          {"folder", shell_word(s.folder)},
          {"stem", fs::path(s.plan).stem().string()},
          {"name", engine_name(s.plan)},
          {"shares", text(s.shares)},
          {"cores", text(s.cores)},
          {"minutes", text(s.minutes)},
          {"memory", text(s.memory_mib)},
          {"attempts", text(s.attempts)},
          {"retries", text(s.attempts - 1)},
          {"failures", text(s.shares * (s.attempts - 1))},
          {"after first", s.has_stages ? " --dependency=afterok:\"${first%%;*}\" --kill-on-invalid-dep=yes" : ""},
          {"quoted plan", print_json_line(s.plan)},
          {"quoted folder", print_json_line(s.folder)},
          {"quoted image", print_json_line(s.image)},
          {"quoted claim", print_json_line(s.claim)}};
}

// Beginnings of the scripts of jobs whose shares all need values of the whole job.
constexpr std::string_view slurm_first =
    R"(first=$(sbatch --parsable --job-name={name}-first --cpus-per-task={cores} --mem={memory}M --time={minutes} --requeue \
  --open-mode=append --output={name}-first.log <<'END'
#!/bin/bash
exec "$OMBRE" run "$PLAN" --stages
END
)
)";
constexpr std::string_view kubernetes_first =
    R"(job {name}-first "run, $PLAN, --stages" 'backoffLimit: {retries}' | kubectl apply --filename -
wait_for {name}-first
)";
constexpr std::string_view parallel_first = R"("$OMBRE" run "$PLAN" --stages
)";
constexpr std::string_view dask_first = R"(    subprocess.run([OMBRE, "run", PLAN, "--stages"], cwd=FOLDER, check=True)
)";

constexpr std::string_view slurm = R"(#!/bin/bash
# Hands the shares of a plan to Slurm, as a job array, and a job that joins them. Change what your cluster wants, such as
# --partition or --account, and start this again: shares that are done stay. OMBRE names the program, if it is another.
set -euo pipefail
cd {folder}
export OMBRE="${OMBRE:-ombre}" PLAN={plan}

{first}shares=$(sbatch --parsable --job-name={name} --array=1-{shares} --cpus-per-task={cores} --mem={memory}M \
  --time={minutes}{after first} --requeue --open-mode=append --output={name}-%a.log <<'END'
#!/bin/bash
# The same share is begun again if its machine failed (2), not if the design is wrong (1).
for attempt in $(seq {attempts}); do
  code=0
  "$OMBRE" run "$PLAN" --quiet || code=$?
  [ "$code" -eq 2 ] || exit "$code"
done
exit "$code"
END
)
join=$(sbatch --parsable --job-name={name}-join --dependency=afterok:"${shares%%;*}" --kill-on-invalid-dep=yes \
  --cpus-per-task={cores} --mem={memory}M --time={minutes} --requeue --open-mode=append --output={name}-join.log <<'END'
#!/bin/bash
exec "$OMBRE" gather "$PLAN"
END
)
echo "job ${shares%%;*} makes the shares, job ${join%%;*} joins them; ombre status $PLAN says how far they are"
)";

constexpr std::string_view kubernetes = R"(#!/bin/bash
# Hands the shares of a plan to Kubernetes, as an indexed job, waits for it, and starts a job that joins them. The image
# holds ombre; the claim is a volume that all see, with the plan, the design and its files.
set -euo pipefail

# Writes a job: its name, the arguments of ombre, and lines of its specification.
job() {
  cat <<END
apiVersion: batch/v1
kind: Job
metadata:
  name: $1
spec:
$(printf '  %s\n' "${@:3}")
  template:
    spec:
      restartPolicy: Never
      containers:
      - name: ombre
        image: $IMAGE
        workingDir: /work
        command: [ombre, $2]
        resources:
          requests: {cpu: "{cores}", memory: {memory}Mi}
          limits: {memory: {memory}Mi}
        volumeMounts:
        - {name: work, mountPath: /work}
      volumes:
      - name: work
        persistentVolumeClaim: {claimName: $CLAIM}
END
}

# Waits until a job is done; fails if it failed.
wait_for() {
  while :; do
    case $(kubectl get job "$1" --output 'jsonpath={.status.conditions[?(@.status=="True")].type}') in
      *Complete*) return ;;
      *Failed*) echo "job $1 failed; see: kubectl logs --selector job-name=$1" >&2; return 1 ;;
    esac
    sleep 5
  done
}

IMAGE=$(cat <<'END'
{quoted image}
END
)
CLAIM=$(cat <<'END'
{quoted claim}
END
)
PLAN=$(cat <<'END'
{quoted plan}
END
)
{first}job {name} "run, $PLAN, --quiet" 'completions: {shares}' 'parallelism: {shares}' 'completionMode: Indexed' \
  'backoffLimit: {failures}' | kubectl apply --filename -
wait_for {name}
job {name}-join "gather, $PLAN" 'backoffLimit: {retries}' | kubectl apply --filename -
wait_for {name}-join
)";

constexpr std::string_view parallel = R"(#!/bin/bash
# Hands the shares of a plan to GNU parallel, one at a time on each machine, since a share takes all cores. PARALLEL may
# name machines that see this folder, and more: PARALLEL='--sshlogin here,there --workdir .' OMBRE names the program.
set -euo pipefail
cd {folder}
export OMBRE="${OMBRE:-ombre}" PLAN={plan}
{first}seq {shares} | parallel --will-cite --jobs 1 --env OMBRE --env PLAN --retries {attempts} --halt soon,fail=1 \
  --joblog {name}.log '"$OMBRE" run "$PLAN" --shard {} --quiet'
exec "$OMBRE" gather "$PLAN"
)";

constexpr std::string_view dask = R"(#!/usr/bin/env python3
"""Hands the shares of a plan to Dask, and joins them: give it the scheduler's address, such as tcp://host:8786, where
workers see this folder; without one, it starts a worker here. OMBRE names the program, if it is another."""
import os
import subprocess
import sys

from dask.distributed import Client, as_completed

OMBRE = os.environ.get("OMBRE", "ombre")
PLAN, FOLDER = {quoted plan}, {quoted folder}


def make(share):
    done = subprocess.run([OMBRE, "run", PLAN, "--shard", str(share), "--quiet"], cwd=FOLDER, stderr=subprocess.PIPE,
                          text=True)
    if done.returncode:
        raise RuntimeError(f"share {share}: {done.stderr.strip()}")
    return share


if __name__ == "__main__":
{first}    with Client(sys.argv[1]) if len(sys.argv) > 1 else Client(n_workers=1, threads_per_worker=1) as client:
        futures = client.map(make, range(1, {shares} + 1), retries={retries}, pure=False)
        for count, future in enumerate(as_completed(futures), 1):
            print(f"share {future.result()} is done, {count} of {shares}", file=sys.stderr)
    sys.exit(subprocess.run([OMBRE, "gather", PLAN], cwd=FOLDER).returncode)
)";

template <const std::string_view& text, const std::string_view& first>
std::string script(const Submission& submission) {
  std::vector<Place> places = places_of(submission);
  places.push_back({"first", submission.has_stages ? filled(first, places) : ""});
  return filled(text, places);
}

}  // namespace

const std::vector<Engine>& engines() {
  static const std::vector<Engine> all{
      {"slurm", "sbatch", ".slurm.sh", "bash", false, script<slurm, slurm_first>},
      {"kubernetes", "kubectl", ".kubernetes.sh", "bash", true, script<kubernetes, kubernetes_first>},
      {"parallel", "parallel", ".parallel.sh", "bash", false, script<parallel, parallel_first>},
      {"dask", "python3", ".dask.py", "python3", false, script<dask, dask_first>}};
  return all;
}

std::string shell_word(std::string_view text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

}  // namespace ombre::jobs
