#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>

namespace kagefude {

/// An open file descriptor that closes itself.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  int number() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }

 private:
  int number_ = -1;
};

struct Message {
  std::unique_ptr<nlohmann::json> content;
  Descriptor pixels;  ///< memory that sender and receiver share, when it goes with the message
};

/// One end of a local socket over which two processes exchange messages. Neither end throws for a
/// lost other end; each returns that nothing was sent or came.
class MessageSocket {
 public:
  explicit MessageSocket(Descriptor socket) : socket_(std::move(socket)) {}
  /// Sends a message, with the descriptor `pixels` unless it is -1. False when the other is gone.
  bool send(const nlohmann::json& content, int pixels = -1);
  /// Waits for a message. Nothing when the other end is gone or says what is no message.
  std::optional<Message> receive();

 private:
  Descriptor socket_;
};

}  // namespace kagefude
