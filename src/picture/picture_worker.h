#pragma once

#include <sys/types.h>

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "picture/message_socket.h"

namespace kagefude {

/// What one request to a worker may take.
struct WorkerBounds {
  uint64_t memory = 0;    ///< bytes beyond what the idle worker has
  uint64_t seconds = 60;  ///< of processor time
};

/// A process that has OpenImageIO in it (see oiio/main.cpp). Decoders of damaged files crash, hang
/// and allocate without end: in a process of its own that ends a request and not the program, and
/// the kernel holds it to its bounds. Programs that never ask for one never load the library.
class PictureWorker {
 public:
  /// Starts it. Throws InputError when it is not installed beside this program or in its library
  /// folder, cannot be started, or is of another version. Cost: a quarter of a second.
  PictureWorker();
  ~PictureWorker();
  PictureWorker(const PictureWorker&) = delete;
  PictureWorker& operator=(const PictureWorker&) = delete;

  /// Sends a request, with the shared memory `pixels` unless it is -1, and waits for the answer,
  /// which has a member "error" when the worker could not do it. When the worker did not live to
  /// answer, the error says how it ended, and isAlive() is false from then on.
  nlohmann::json ask(nlohmann::json request, const WorkerBounds& bounds, int pixels = -1);
  bool isAlive() const { return process_ > 0; }

 private:
  void start(const std::string& program);
  int end();  ///< as waitpid() has it

  pid_t process_ = -1;
  std::unique_ptr<MessageSocket> socket_;
};

/// A worker for the time being. Idle ones are kept for the next lease; where all are busy one waits
/// for as long as a start takes, then starts another.
class WorkerLease {
 public:
  WorkerLease();
  ~WorkerLease();
  WorkerLease(WorkerLease&&) = default;
  PictureWorker* operator->() { return worker_.get(); }

 private:
  std::unique_ptr<PictureWorker> worker_;
};

}  // namespace kagefude
