// kagefude_fuzz HARNESS [libFuzzer's options and folders]
// kagefude_fuzz list|dictionary     names of the harnesses; words of looks, for -dict=
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <set>
#include <string>

#include "fuzz/harness.h"
#include "look/look_sections.h"

namespace {

using kagefude::fuzz::Harness;

const Harness* chosen = nullptr;

/// Every section, key and choice that a look knows, from the parameter tables.
void printDictionary() {
  std::set<std::string> words{"[[light]]", "[[style]]", "kagefude", "light", "style", "= ["};
  for (const kagefude::LookSection& section : kagefude::lookSections) {
    words.insert("[" + std::string(section.table->pass) + "]");
    words.insert(std::string(section.table->pass) + ".");
    for (const kagefude::Parameter& parameter : section.table->parameters) {
      words.insert(std::string(parameter.name) + " = ");
      for (const std::string_view choice : parameter.choices)
        words.insert("'" + std::string(choice) + "'");
    }
  }
  for (const std::string& word : words) std::cout << '"' << word << "\"\n";
}

[[noreturn]] void usage() {
  std::cerr << "usage: kagefude_fuzz HARNESS|list|dictionary [libFuzzer's options and folders]\n";
  std::exit(2);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  if (*argc < 2) usage();
  const std::string name = (*argv)[1];
  for (const Harness& harness : kagefude::fuzz::harnesses()) {
    if (name == "list") std::cout << harness.name << '\n';
    if (name == harness.name) chosen = &harness;
  }
  if (name == "dictionary") printDictionary();
  if (name == "dictionary" || name == "list") std::exit(0);
  if (!chosen) usage();
  for (int i = 1; i + 1 < *argc; ++i) (*argv)[i] = (*argv)[i + 1];
  --*argc;
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  chosen->run({reinterpret_cast<const char*>(data), size});
  return 0;
}
