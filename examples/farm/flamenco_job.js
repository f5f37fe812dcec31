// SPDX-License-Identifier: Apache-2.0
// A Flamenco 3 job type: put it into the manager's `scripts` folder. A task per chunk of the frames;
// a task that runs again goes on where it ended.

const JOB_TYPE = {
  label: "kagefude comp",
  description: "Composite rendered frames with a kagefude look",
  settings: [
    { key: "look", type: "string", subtype: "file_path", required: true,
      description: "Look file (TOML)" },
    { key: "input", type: "string", required: true,
      description: "Frames (EXR), such as /shot/aovs/shot.####.exr" },
    { key: "output", type: "string", required: true,
      description: "Frames to write (EXR), such as /shot/out/shot.####.exr" },
    { key: "frames", type: "string", required: true, default: "1-24",
      description: "Such as 1-24, 1-24x2 or 1,5,9" },
    { key: "chunks", type: "int32", default: 4,
      description: "How many tasks the frames are shared by" },
    { key: "kagefude", type: "string", default: "kagefude", visible: "submission",
      description: "The program, as the workers find it" },
    { key: "report", type: "string", subtype: "dir_path", default: "", visible: "submission",
      description: "Folder for a page about all frames; empty for none" },
  ],
};

function compArguments(settings) {
  return ["comp", settings.look, settings.input, "--output", settings.output,
          "--frames", settings.frames, "--existing", "update", "--skip-bad-frames",
          "--progress", "plain"];
}

function addTask(job, name, args, after) {
  const task = author.Task(name, "misc");
  task.addCommand(author.Command("exec", { exe: job.settings.kagefude, args: args }));
  for (const earlier of after) {
    task.addDependency(earlier);
  }
  job.addTask(task);
  return task;
}

function compileJob(job) {
  const chunks = Math.max(1, job.settings.chunks);
  const tasks = [];
  for (let i = 1; i <= chunks; i++) {
    const args = compArguments(job.settings).concat(["--chunk", `${i}/${chunks}`]);
    tasks.push(addTask(job, `comp-${i}-of-${chunks}`, args, []));
  }
  if (job.settings.report) {
    addTask(job, "report", compArguments(job.settings).concat(["--report", job.settings.report]), tasks);
  }
}
