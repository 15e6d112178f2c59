// SPDX-License-Identifier: MIT
// Any text as the command line of an example, a word a line; the first byte chooses which. It is refused with an exit
// code, or gives a task; nothing escapes.
#include "common/design_options.hpp"
#include "common/palpate_options.hpp"
#include "common/transparency_options.hpp"

#include <cstddef>
#include <cstdint>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace {

// Words that would read or write files.
bool names_a_file(const std::string& word) {
  for (const char* option : {"--json", "--csv", "--plot", "--force"}) {
    if (word == option || word.rfind(std::string(option) + "=", 0) == 0) return true;
  }
  return false;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace limpid::examples;
  std::cout.setstate(std::ios::failbit);  // what is refused is said
  std::cerr.setstate(std::ios::failbit);
  if (size == 0) return 0;
  std::istringstream text(std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
  std::vector<std::string> words{"example"};
  for (std::string word; std::getline(text, word);) {
    word = word.substr(0, word.find('\0'));
    if (!names_a_file(word)) words.push_back(word);
  }
  std::vector<const char*> argv;
  for (const std::string& word : words) argv.push_back(word.c_str());
  const int argc = static_cast<int>(argv.size());
  switch (data[0] % 3) {
    case 0:
      (void)parse_design_options(argc, argv.data());
      break;
    case 1:
      (void)parse_palpate_options(argc, argv.data());
      break;
    default:
      (void)parse_transparency_options(argc, argv.data());
  }
  return 0;
}
