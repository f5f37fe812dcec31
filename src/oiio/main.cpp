// The program that reads and writes pictures with OpenImageIO for kagefude, by messages over the
// socket that is its standard input. It is a process of its own because decoders of damaged files
// crash, hang and take memory without end, and because OpenImageIO takes a quarter of a second to
// load; see picture/picture_worker.h.
#include <OpenImageIO/imageio.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <new>
#include <nlohmann/json.hpp>

#include "oiio/read_picture.h"
#include "oiio/write_picture.h"
#include "picture/message_socket.h"
#include "picture/shared_pixels.h"

namespace kagefude::oiio {
namespace {

using nlohmann::json;

/// Bytes of address space that the process has now.
rlim_t addressSpace() {
  unsigned long pages = 0;
  if (FILE* const file = std::fopen("/proc/self/statm", "re")) {
    if (std::fscanf(file, "%lu", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

/// What a request may take beyond what the idle process has. Where it takes more, memory is refused
/// to it or it is killed.
void allow(const json& request, rlim_t idle) {
  rlimit memory{}, time{};
  getrlimit(RLIMIT_AS, &memory);
  memory.rlim_cur = idle + request.at("memory").get<rlim_t>();
  setrlimit(RLIMIT_AS, &memory);
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  getrlimit(RLIMIT_CPU, &time);
  time.rlim_cur = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                  request.at("seconds").get<rlim_t>();
  setrlimit(RLIMIT_CPU, &time);
}

WrittenPicture writtenPicture(const json& request) {
  WrittenPicture picture{request.at("path"), request.at("name"), "", 0,
                         headerFrom(request.at("header"))};
  if (request.contains("metadata")) {
    picture.metadataFile = request.at("metadata").at(0);
    picture.metadataPart = request.at("metadata").at(1);
  }
  return picture;
}

/// Serves one request after the other.
class Server {
 public:
  json answer(Message& message) {
    const json& request = *message.content;
    const std::string what = request.at("do");
    if (what == "open") {
      picture_ = OpenedPicture();
      picture_ = openPicture(request.at("path"));
      return {{"header", toJson(picture_.header)}};
    }
    const SharedPixels pixels(std::move(message.pixels), request.at("bytes"));
    if (what == "read") {
      std::vector<WantedPlane> wanted;
      for (const json& plane : request.at("planes"))
        wanted.push_back(
            {plane.at(0), static_cast<PlaneType>(plane.at(1).get<int>()), plane.at(2)});
      readPlanes(picture_, wanted, pixels.data());
    } else {
      writePicture(writtenPicture(request), reinterpret_cast<const float*>(pixels.data()));
    }
    return json::object();
  }

 private:
  OpenedPicture picture_;
};

json answerOrError(Server& server, Message& message) {
  try {
    return server.answer(message);
  } catch (const std::bad_alloc&) {
    return {{"error", "it takes more memory than a file of its size may"}};
  } catch (const std::exception& problem) {
    return {{"error", problem.what()}};
  }
}

int serve() {
  MessageSocket socket{Descriptor(STDIN_FILENO)};
  // Ours to end is the program at the other end of the socket, which the same signals reach; a
  // limit of file sizes is an error of a write.
  for (const int ignored : {SIGINT, SIGTERM, SIGHUP, SIGXFSZ}) std::signal(ignored, SIG_IGN);
  const rlimit noCore{0, 0};
  setrlimit(RLIMIT_CORE, &noCore);
  mallopt(M_ARENA_MAX, 1);  // an arena a thread claims 64 MiB of address space each
  OIIO::attribute("threads", 1);
  OIIO::ImageInput::create("tiff");  // makes the table of formats
  const rlim_t idle = addressSpace();
  if (!socket.send({{"version", KAGEFUDE_VERSION}})) return 1;
  Server server;
  while (auto message = socket.receive()) {
    allow(*message->content, idle);
    if (!socket.send(answerOrError(server, *message))) break;
  }
  return 0;
}

}  // namespace
}  // namespace kagefude::oiio

int main() {
  const int code = kagefude::oiio::serve();
  // The libraries' own clean-up takes a while, and nothing is left to be cleaned.
  _exit(code);
}
