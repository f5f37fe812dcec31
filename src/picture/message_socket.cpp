#include "picture/message_socket.h"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

namespace kagefude {
namespace {

constexpr uint32_t longestMessage = 64u << 20;

bool sendAll(int socket, const uint8_t* bytes, size_t count) {
  while (count > 0) {
    const ssize_t sent = send(socket, bytes, count, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    bytes += sent;
    count -= static_cast<size_t>(sent);
  }
  return true;
}

bool receiveAll(int socket, uint8_t* bytes, size_t count) {
  while (count > 0) {
    const ssize_t got = recv(socket, bytes, count, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    bytes += got;
    count -= static_cast<size_t>(got);
  }
  return true;
}

/// The message's length, with a place for a descriptor beside it.
struct Start {
  explicit Start(uint32_t* length) : data{length, sizeof(*length)} {
    header.msg_iov = &data;
    header.msg_iovlen = 1;
    header.msg_control = control;
    header.msg_controllen = sizeof(control);
  }
  iovec data;
  msghdr header{};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))] = {};
};

}  // namespace

Descriptor::~Descriptor() {
  if (number_ >= 0) close(number_);
}
Descriptor::Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

bool MessageSocket::send(const nlohmann::json& content, int pixels) {
  const std::vector<uint8_t> bytes = nlohmann::json::to_msgpack(content);
  auto length = static_cast<uint32_t>(bytes.size());
  if (bytes.size() > longestMessage) return false;
  Start start(&length);
  if (pixels < 0) {
    start.header.msg_controllen = 0;
  } else {
    cmsghdr* const rights = CMSG_FIRSTHDR(&start.header);
    rights->cmsg_level = SOL_SOCKET;
    rights->cmsg_type = SCM_RIGHTS;
    rights->cmsg_len = CMSG_LEN(sizeof(int));
    std::memcpy(CMSG_DATA(rights), &pixels, sizeof(int));
  }
  ssize_t sent;
  do sent = sendmsg(socket_.number(), &start.header, MSG_NOSIGNAL);
  while (sent < 0 && errno == EINTR);
  if (sent != static_cast<ssize_t>(sizeof(length))) return false;
  return sendAll(socket_.number(), bytes.data(), bytes.size());
}

std::optional<Message> MessageSocket::receive() {
  uint32_t length = 0;
  Start start(&length);
  ssize_t got;
  do got = recvmsg(socket_.number(), &start.header, MSG_CMSG_CLOEXEC | MSG_WAITALL);
  while (got < 0 && errno == EINTR);
  Message message;
  const cmsghdr* const rights = got > 0 ? CMSG_FIRSTHDR(&start.header) : nullptr;
  if (rights && rights->cmsg_type == SCM_RIGHTS) {
    int pixels = -1;
    std::memcpy(&pixels, CMSG_DATA(rights), sizeof(int));
    message.pixels = Descriptor(pixels);
  }
  if (got != static_cast<ssize_t>(sizeof(length)) || length > longestMessage) return std::nullopt;
  std::vector<uint8_t> bytes(length);
  if (!receiveAll(socket_.number(), bytes.data(), bytes.size())) return std::nullopt;
  auto content = nlohmann::json::from_msgpack(bytes, true, false);
  if (content.is_discarded()) return std::nullopt;
  message.content = std::make_unique<nlohmann::json>(std::move(content));
  return message;
}

}  // namespace kagefude
