#pragma once

#include <stdexcept>
#include <string>

namespace kagefude {

/// Base of every error that the library throws. The message is one lower-case sentence without a
/// full stop that says where (file, frame, layer), what was expected and what was found.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A frame, sidecar, strip or depth map cannot be used as it is. The program exits with 1.
class InputError : public Error {
 public:
  using Error::Error;
};

/// The look file or an override of it is wrong. Nothing was touched; the program exits with 2.
class LookError : public Error {
 public:
  using Error::Error;
};

/// The command line is wrong. Nothing was touched; the program exits with 2.
class UsageError : public Error {
 public:
  using Error::Error;
};

/// A result cannot be written (full disk, read-only folder). The program exits with 1.
class OutputError : public Error {
 public:
  using Error::Error;
};

}  // namespace kagefude
