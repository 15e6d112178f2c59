// SPDX-License-Identifier: MIT
#include "child_process.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <system_error>

namespace limpid::emulator {
namespace {

constexpr std::string_view preload = "libumockdev-preload.so.0";

std::string joined(std::string_view name, std::string_view value, char separator) {
  const char* is = std::getenv(std::string(name).c_str());
  std::string text = std::string(name) + '=' + std::string(value);
  return is != nullptr && *is != '\0' ? text + separator + is : text;
}

// This one's, with the preloaded library, which a program with the address sanitizer must not mind.
std::vector<std::string> environment() {
  std::vector<std::string> all{joined("LD_PRELOAD", preload, ':'),
                               joined("ASAN_OPTIONS", "verify_asan_link_order=0", ':')};
  for (char** one = environ; *one != nullptr; ++one) {
    const std::string_view text(*one);
    if (!text.starts_with("LD_PRELOAD=") && !text.starts_with("ASAN_OPTIONS=")) all.emplace_back(text);
  }
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> all;
  for (std::string& word : words) all.push_back(word.data());
  all.push_back(nullptr);
  return all;
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments) {
  std::vector<std::string> words = arguments, variables = environment();
  const int error = ::posix_spawnp(&id_, arguments.at(0).c_str(), nullptr, nullptr, pointers(words).data(),
                                   pointers(variables).data());
  if (error != 0) throw std::system_error(error, std::generic_category(), arguments[0]);
}

ChildProcess::~ChildProcess() {
  if (ended()) return;
  signal(SIGKILL);
  ::waitpid(id_, nullptr, 0);
}

void ChildProcess::signal(int number) const {
  if (!code_) ::kill(id_, number);
}

std::optional<int> ChildProcess::ended() {
  int status = 0;
  if (!code_ && ::waitpid(id_, &status, WNOHANG) == id_)
    code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return code_;
}

}  // namespace limpid::emulator
