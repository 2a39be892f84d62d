#pragma once
// Runs the real program, as a user would.

#include <filesystem>
#include <string>
#include <vector>

namespace lightbench {

struct ProgramResult {
  int exit_code = -1;  ///< 128 + signal if one ended it
  std::string out;
  std::string err;
};

/// A folder that is removed at the end of the test.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::vector<std::string> names() const;  ///< of the files in it, sorted

 private:
  std::filesystem::path path_;
};

/// A running `lightbench ARGUMENTS` in folder `where`.
class Program {
 public:
  Program(const std::filesystem::path& where, const std::vector<std::string>& arguments);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  void send(int signal) const;
  ProgramResult wait();

 private:
  TemporaryFolder streams_;
  int process_ = -1;
};

ProgramResult run_lightbench(const std::filesystem::path& where,
                             const std::vector<std::string>& arguments);

std::string read_text(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace lightbench
