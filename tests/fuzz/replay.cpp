// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "target.hpp"

/// Runs the fuzz target without a fuzzer: on the corpus, then on mutations of it from a fixed seed.
///
///     replay [number of mutations] [seed]        replay --write-corpus FOLDER        replay --file FILE
///
/// Corpus and words are those of the target (target.hpp).
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Splitmix64: the same mutations on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(next() % n); }

 private:
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15U);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

void mutate(std::string& text, const std::vector<std::string>& texts, const std::vector<std::string>& words,
            Random& random) {
  const std::size_t at = random.below(text.size() + 1),
                    length = random.below(std::min<std::size_t>(text.size() - at, 20) + 1);
  switch (random.below(6)) {
    case 0:
      if (at < text.size()) text[at] = static_cast<char>(random.below(256));
      break;
    case 1:
      text.erase(at, length);
      break;
    case 2:
      text.insert(at, text.substr(at, length));
      break;
    case 3:
    case 4:
      text.replace(at, random.below(3) == 0 ? length : 0, words[random.below(words.size())]);
      break;
    default: {
      const std::string& other = texts[random.below(texts.size())];
      text = text.substr(0, at) + other.substr(random.below(other.size() + 1));
    }
  }
}

/// Long, deep and huge: a word, or a piece of the text, many times over. Seldom, for it takes time to read.
void lengthen(std::string& text, const std::vector<std::string>& words, Random& random) {
  constexpr std::size_t kSeldom = 100, kMostDoublings = 15, kLongestPiece = 40, kMostBytes = 1 << 19;
  if (random.below(kSeldom) != 0) return;
  const std::size_t at = random.below(text.size() + 1);
  const std::string piece = random.below(2) == 0 ? words[random.below(words.size())]
                                                 : text.substr(at, 1 + random.below(kLongestPiece));
  std::string many;
  for (std::size_t n = std::size_t{1} << random.below(kMostDoublings); n > 0 && many.size() < kMostBytes; --n)
    many += piece;
  text.insert(at, many);
}

/// What is being read, for report_text().
const std::string* current = nullptr;

/// A property that does not hold aborts (report.hpp): says on which text.
extern "C" void report_text(int /*signal*/) {
  if (current) std::cerr << "on\n" << *current << std::endl;
}

void run(const std::string& text) {
  current = &text;
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  std::signal(SIGABRT, report_text);
  const auto texts = shearfront::fuzz::corpus();
  const auto words = shearfront::fuzz::words();
  if (arguments.size() == 2 && arguments[0] == "--file") {
    run(content_of(arguments[1]));
    return 0;
  }
  if (arguments.size() == 2 && arguments[0] == "--write-corpus") {
    fs::create_directories(arguments[1]);
    for (std::size_t i = 0; i < texts.size(); ++i)
      std::ofstream(fs::path(arguments[1]) / std::to_string(i), std::ios::binary) << texts[i];
    return 0;
  }
  const std::size_t n = arguments.empty() ? 10000 : std::stoul(arguments[0]);
  const std::uint64_t seed = arguments.size() < 2 ? 1 : std::stoull(arguments[1]);
  Random random(seed);
  std::string text;
  try {
    for (const std::string& original : texts) run(text = original);
    for (std::size_t i = 0; i < n; ++i) {
      text = texts[random.below(texts.size())];
      for (std::size_t k = 0, steps = 1 + random.below(8); k < steps; ++k) mutate(text, texts, words, random);
      lengthen(text, words, random);
      run(text);
    }
  } catch (const std::exception& error) {
    std::cerr << "seed " << seed << ": an exception that is no FileError: " << error.what() << "\non\n"
              << text << '\n';
    return 1;
  }
  std::cout << texts.size() << " texts and " << n << " mutations, seed " << seed << '\n';
  return 0;
}
