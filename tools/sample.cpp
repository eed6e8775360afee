// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/scene_changes.hpp"

namespace shearfront::tools {
namespace {

/// Sampling is the business of the Python package, which drives samplers that others keep well: its module takes the place of
/// this process. SHEARFRONT_PYTHON names another interpreter than python3.
int sample_posterior(const std::vector<std::string>& arguments) {
  const char* python = std::getenv("SHEARFRONT_PYTHON");  // NOLINT(concurrency-mt-unsafe): no other threads
  std::vector<std::string> words{
      python && *python ? python : "python3", "-c",
      "import importlib.util, sys\n"
      "if importlib.util.find_spec('shearfront') is None: sys.exit(\"shearfront: no "
      "result: sample needs the Python package: pip install 'shearfront[bayes]'\")\n"
      "from shearfront.sample import main\n"
      "sys.exit(main(sys.argv[1:]))"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execvp(pointers.front(), pointers.data());
  fmt::print(stderr, "shearfront: no result: sample needs {} and the Python package shearfront\n",
             words.front());
  return kNoResult;
}

}  // namespace

Command add_sample(CLI::App& program) {
  struct Arguments {
    std::string file, output, draws, chains, tune, seed, sampler;
    SceneChangesOption changes;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* app = program.add_subcommand(
      "sample",
      "Samples of the posterior of a fit: what data and [prior] say together (by the Python package)");
  app->add_option("FIT", arguments->file, "fit file")->type_name("")->required();
  arguments->changes.add_to(*app);
  app->add_option("-o", arguments->output, "all draws as CSV: chain, draw, unknowns")->type_name("FILE");
  app->add_option("--draws", arguments->draws, "of each chain, default 1000")->type_name("N");
  app->add_option("--chains", arguments->chains, "default 4")->type_name("N");
  app->add_option("--tune", arguments->tune, "draws before the first that counts, default 400")
      ->type_name("N");
  app->add_option("--seed", arguments->seed, "default 1")->type_name("N");
  app->add_option("--sampler", arguments->sampler, "default nutpie; emcee needs no gradient: for points")
      ->type_name("nutpie|emcee");
  return {app, "FIT", [arguments] {
            (void)arguments->changes.changes();  // refuses what is none
            std::vector<std::string> words{arguments->file};
            for (const std::string& change : arguments->changes.words())
              words.insert(words.end(), {"--set", change});
            const auto add = [&](const char* option, const std::string& value) {
              if (!value.empty()) words.insert(words.end(), {option, value});
            };
            add("-o", arguments->output);
            add("--draws", arguments->draws);
            add("--chains", arguments->chains);
            add("--tune", arguments->tune);
            add("--seed", arguments->seed);
            add("--sampler", arguments->sampler);
            return sample_posterior(words);
          }};
}

}  // namespace shearfront::tools
