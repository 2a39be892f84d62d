#include "tests/unit/program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace lightbench {

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "lightbench-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> TemporaryFolder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path_)) {
    if (entry.is_regular_file()) names.push_back(relative(entry.path(), path_).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

Program::Program(const std::filesystem::path& where, const std::vector<std::string>& arguments) {
  const std::string out = (streams_.path() / "out").string();
  const std::string err = (streams_.path() / "err").string();
  std::string program = LIGHTBENCH_EXE;
  std::vector<std::string> copies = arguments;
  std::vector<char*> argv{program.data()};
  for (std::string& argument : copies) argv.push_back(argument.data());
  argv.push_back(nullptr);
  process_ = fork();
  if (process_ == 0) {
    const auto redirect = [](const std::string& name, int stream) {
      const int file = open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      if (file < 0 || dup2(file, stream) < 0) _exit(127);
    };
    redirect(out, STDOUT_FILENO);
    redirect(err, STDERR_FILENO);
    if (chdir(where.c_str()) != 0) _exit(127);
    execv(argv[0], argv.data());
    _exit(127);
  }
}

Program::~Program() {
  if (process_ > 0) {
    send(SIGKILL);
    wait();
  }
}

void Program::send(int signal) const { kill(process_, signal); }

ProgramResult Program::wait() {
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = -1;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          read_text(streams_.path() / "out"), read_text(streams_.path() / "err")};
}

ProgramResult run_lightbench(const std::filesystem::path& where,
                             const std::vector<std::string>& arguments) {
  return Program(where, arguments).wait();
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

}  // namespace lightbench
