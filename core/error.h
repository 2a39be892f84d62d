#pragma once
// The one exception type that crosses module borders. Its message is a single line that says where
// the fault is (file and JSON pointer, or flag) and what was expected; its kind names the exit
// code.

#include <stdexcept>
#include <string>

namespace lightbench {

/// Values are the process exit codes of the command line.
enum class ErrorKind { Internal = 1, Usage = 2, Scene = 3, Output = 4 };

class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  [[nodiscard]] ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

}  // namespace lightbench
