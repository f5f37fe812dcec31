#!/usr/bin/env bash
# The farm examples are well formed, and what they call does what they say.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/frames.sh"

check "slurm_array.sh" bash -n examples/farm/slurm_array.sh
check "flamenco_job.js is no JavaScript" node --check examples/farm/flamenco_job.js

# The Flamenco job, compiled by stand-ins for what Flamenco's manager gives it: chunks and options.
cat >"$work/compile.js" <<'JS'
const fs = require("fs");
const vm = require("vm");
const author = {
  Task: (name, type) => ({ name, type, commands: [], dependencies: [],
    addCommand(c) { this.commands.push(c); }, addDependency(t) { this.dependencies.push(t.name); } }),
  Command: (name, parameters) => ({ name, parameters }),
};
const job = { tasks: [], addTask(t) { this.tasks.push(t); }, settings: JSON.parse(process.argv[3]) };
vm.runInNewContext(fs.readFileSync(process.argv[2], "utf8") + "\nthis.compileJob(job)", { author, job });
for (const task of job.tasks) {
  const { exe, args } = task.commands[0].parameters;
  console.log([exe].concat(args).join("\t"));
}
JS
make_frames "$work/in" 6
echo >"$work/look.toml"
settings="{\"look\": \"$work/look.toml\", \"input\": \"$work/in/shot.####.exr\", \"output\": \"$work/flamenco/shot.####.exr\",
  \"frames\": \"1-6\", \"chunks\": 3, \"kagefude\": \"$kagefude\", \"report\": \"$work/report\"}"
node "$work/compile.js" examples/farm/flamenco_job.js "$settings" >"$work/calls"
check "three chunks and a report" test "$(wc -l <"$work/calls")" -eq 4
while IFS=$'\t' read -r -a call; do
  check "${call[*]}" "${call[@]}" 2>"$work/log"
done <"$work/calls"
check "the report" test -s "$work/report/index.html"

# The OpenJD template: parsed, its references exist, and its command runs once they are filled in.
cat >"$work/fill.py" <<'PY'
import re, sys, yaml
template = yaml.safe_load(open(sys.argv[1]))
values = dict(pair.split("=", 1) for pair in sys.argv[2:])
assert template["specificationVersion"] == "jobtemplate-2023-09"
parameters = {p["name"]: p for p in template["parameterDefinitions"]}
assert set(values) <= set(parameters), "no such parameter"
known = {f"Param.{name}": values.get(name, str(p.get("default"))) for name, p in parameters.items()}
fill = lambda text: re.sub(r"\{\{ *([\w.]+) *\}\}", lambda m: known[m[1]], text)
fill(template["name"])
for step in template["steps"]:
    task = step["parameterSpace"]["taskParameterDefinitions"][0]
    first, last = map(int, fill(task["range"]).split("-"))
    run = step["script"]["actions"]["onRun"]
    for number in range(first, last + 1):
        known["Task.Param." + task["name"]] = str(number)
        print("\t".join(fill(word) for word in [run["command"], *run["args"]]))
PY
python3 "$work/fill.py" examples/farm/openjd_template.yaml "Look=$work/look.toml" "Input=$work/in/shot.####.exr" \
  "Output=$work/openjd/shot.####.exr" Frames=1-6 Chunks=2 "Kagefude=$kagefude" >"$work/calls"
check "two chunks" test "$(wc -l <"$work/calls")" -eq 2
while IFS=$'\t' read -r -a call; do
  check "${call[*]}" "${call[@]}" 2>"$work/log"
done <"$work/calls"
check "OpenJD reads its progress" grep -q '^openjd_progress: 100$' "$work/log"

# The Slurm script, as Slurm would call it; and the call from Nuke.
SLURM_ARRAY_TASK_ID=1 SLURM_ARRAY_TASK_COUNT=1 KAGEFUDE=$kagefude examples/farm/slurm_array.sh "$work/look.toml" \
  "$work/in/shot.####.exr" "$work/slurm/shot.####.exr" 1-6 2>"$work/log"
PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=examples/farm KAGEFUDE=$kagefude python3 - "$work" <<'PY'
import sys
import nuke_comp
work = sys.argv[1]
for frame in range(1, 7):
    nuke_comp.comp(work + "/look.toml", work + "/in/shot.####.exr", work + "/nuke/shot.####.exr", frame)
try:
    nuke_comp.comp(work + "/look.toml", work + "/in/shot.####.exr", work + "/nuke/shot.####.exr", 99)
    sys.exit("a missing frame is no error")
except RuntimeError as error:
    assert "99" in str(error), error
PY
for way in openjd slurm nuke; do
  check "$way makes other files than Flamenco" same_files "$work/flamenco" "$work/$way"
done
summary
