// SPDX-License-Identifier: BSD-3-Clause
#include "method_of.hpp"

#include <algorithm>
#include <string>

#include "shearfront/io/method_text.hpp"

namespace shearfront::web {

Method method_of(std::string_view text) {
  const auto take_word = [&text] {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), word.size() + 1));
    return word;
  };
  Method method(take_word());
  while (!text.empty()) {
    const std::string_view word = take_word();
    const std::size_t equals = std::min(word.find('='), word.size());
    const std::string name(word.substr(0, equals));
    if (equals < word.size() && method.has_option(name))
      set_option(method, name, word.substr(equals + 1), name);
  }
  return method;
}

}  // namespace shearfront::web
