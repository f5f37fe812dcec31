#include "picture/picture_worker.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/error.h"

extern char** environ;

namespace kagefude {
namespace {

namespace fs = std::filesystem;

constexpr const char* workerName = "kagefude-oiio";

/// Beside this program, as in a build folder, where the program's installation has it, or, for
/// other programs that have the library in them, where it was installed first.
std::string findWorker() {
  std::error_code failed;
  const fs::path self = fs::read_symlink("/proc/self/exe", failed);
  const fs::path beside = self.parent_path() / workerName;
  const fs::path installed =
      (self.parent_path() / KAGEFUDE_WORKER_FOLDER / workerName).lexically_normal();
  for (const fs::path& place :
       {beside, installed, fs::path(KAGEFUDE_WORKER_INSTALLED) / workerName})
    if (access(place.c_str(), X_OK) == 0) return place.string();
  throw InputError(
      fmt::format("{}, the part of kagefude that reads and writes pictures with OpenImageIO, is "
                  "neither {} nor {}",
                  workerName, beside.string(), installed.string()));
}

[[noreturn]] void failToStart(const std::string& program, const std::string& why) {
  throw InputError(fmt::format("{} cannot be started: {}", program, why));
}

/// What the child's descriptors are: the socket for input, nothing for words of libraries.
class FileActions {
 public:
  explicit FileActions(int socket) {
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, socket, STDIN_FILENO);
    for (const int output : {STDOUT_FILENO, STDERR_FILENO})
      posix_spawn_file_actions_addopen(&actions, output, "/dev/null", O_WRONLY, 0);
  }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  posix_spawn_file_actions_t actions;
};

std::string howItEnded(int status, bool writing) {
  const char* const coder = writing ? "encoder" : "decoder";
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    return fmt::format("its {} takes too long", coder);
  if (WIFSIGNALED(status) && writing)
    return fmt::format("its encoder was ended by signal {}", WTERMSIG(status));
  if (WIFSIGNALED(status))
    return fmt::format("it is damaged in a way that its decoder did not survive (signal {})",
                       WTERMSIG(status));
  return fmt::format("its {} gave up (exit {})", coder, WEXITSTATUS(status));
}

/// Of a worker that did not come to say hello.
std::string whyNotStarted(int status) {
  if (WIFSIGNALED(status)) return fmt::format("it was ended by signal {}", WTERMSIG(status));
  return fmt::format("it ends at once (exit {}); are OpenImageIO's libraries installed?",
                     WEXITSTATUS(status));
}

/// Idle workers, how many there are in all, and how many of those load their libraries.
struct Pool {
  std::mutex mutex;
  std::condition_variable freed;
  std::vector<std::unique_ptr<PictureWorker>> idle;
  size_t all = 0, starting = 0;
};

Pool& pool() {
  static Pool pool;
  return pool;
}

}  // namespace

PictureWorker::PictureWorker() {
  const std::string program = findWorker();
  start(program);
  const auto hello = socket_->receive();
  if (!hello) failToStart(program, whyNotStarted(end()));
  const std::string version = hello->content->value("version", "");
  if (version != KAGEFUDE_VERSION) {
    end();
    failToStart(program,
                fmt::format("it is of version {}, and this is {}", version, KAGEFUDE_VERSION));
  }
}

PictureWorker::~PictureWorker() { end(); }

void PictureWorker::start(const std::string& program) {
  int ends[2] = {-1, -1};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    failToStart(program, std::strerror(errno));
  socket_ = std::make_unique<MessageSocket>(Descriptor(ends[0]));
  const Descriptor theirs(ends[1]);
  const FileActions files(theirs.number());
  std::string name = program;
  char* const arguments[] = {name.data(), nullptr};
  const int error =
      posix_spawn(&process_, program.c_str(), &files.actions, nullptr, arguments, environ);
  if (error != 0) {
    process_ = -1;
    failToStart(program, std::strerror(error));
  }
}

int PictureWorker::end() {
  socket_.reset();
  int status = 0;
  if (process_ <= 0) return status;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return status;
}

nlohmann::json PictureWorker::ask(nlohmann::json request, const WorkerBounds& bounds, int pixels) {
  request["memory"] = bounds.memory;
  request["seconds"] = bounds.seconds;
  if (socket_ && socket_->send(request, pixels))
    if (auto answer = socket_->receive()) return std::move(*answer->content);
  return {{"error", howItEnded(end(), request.at("do") == "write")}};
}

// Two that start at once take twice as long: nobody starts one beside another's start, nor before
// those at work had the time of a start to come free.
WorkerLease::WorkerLease() {
  constexpr std::chrono::milliseconds aStart(300);
  std::unique_lock lock(pool().mutex);
  for (bool waited = false; pool().idle.empty() && (!waited || pool().starting > 0);) {
    pool().freed.wait(lock, [] { return !pool().idle.empty() || pool().starting == 0; });
    waited = waited || pool().all == 0 ||
             !pool().freed.wait_for(lock, aStart, [] { return !pool().idle.empty(); });
  }
  if (!pool().idle.empty()) {
    worker_ = std::move(pool().idle.back());
    pool().idle.pop_back();
    return;
  }
  ++pool().all;
  ++pool().starting;
  lock.unlock();
  try {
    worker_ = std::make_unique<PictureWorker>();
  } catch (...) {
    lock.lock();
    --pool().all;
    --pool().starting;
    pool().freed.notify_all();
    throw;
  }
  lock.lock();
  --pool().starting;
  pool().freed.notify_all();
}

WorkerLease::~WorkerLease() {
  if (!worker_) return;  // moved
  {
    const std::lock_guard lock(pool().mutex);
    if (worker_->isAlive())
      pool().idle.push_back(std::move(worker_));
    else
      --pool().all;
  }
  pool().freed.notify_one();
}

}  // namespace kagefude
