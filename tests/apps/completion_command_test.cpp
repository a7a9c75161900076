// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "core/file.h"
#include "tests/apps/run_command.h"

namespace exemplar {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(CompletionCommand, KnowsCommandsOptionsChoicesAndScenes) {
  const TestFolder folder;
  for (const std::string shell : {"bash", "zsh", "fish"}) {
    const CommandResult run = runExemplar("completion " + shell, folder.path());
    EXPECT_EQ(run.status, 0) << run.err;
    for (const char* word : {"synth", "compare", "resolution", "quilting", "chainmail"})
      EXPECT_THAT(run.out, HasSubstr(word)) << shell;
  }
}

/// What bash proposes for the last of the words.
std::string proposedByBash(const TestFolder& folder, const std::string& words) {
  const std::string file = folder / "proposed";
  const std::string script = "cd '" + folder.path().string() +
                             "' && . ./completion && COMP_WORDS=(" + words +
                             ") COMP_CWORD=$((${#COMP_WORDS[@]}-1)) && _exemplar && "
                             "printf '%s ' \"${COMPREPLY[@]}\" > proposed";
  writeFile(folder / "script", script);
  if (std::system(("bash '" + (folder / "script").string() + "'").c_str()) != 0) return "failed";
  return readFile(file);
}

TEST(CompletionCommand, BashProposesWhatMayFollow) {
  const TestFolder folder;
  writeFile(folder / "completion", runExemplar("completion bash", folder.path()).out);
  writeFile(folder / "castle_wall.obj", "v 0 0 0\n");
  EXPECT_EQ(proposedByBash(folder, "exemplar rend"), "render ");
  EXPECT_EQ(proposedByBash(folder, "exemplar synth --engi"), "--engine ");
  EXPECT_EQ(proposedByBash(folder, "exemplar synth --engine quil"), "quilting ");
  EXPECT_THAT(proposedByBash(folder, "exemplar synth cast"), HasSubstr("castle "));
  EXPECT_THAT(proposedByBash(folder, "exemplar synth cast"), HasSubstr("castle_wall.obj "));
  EXPECT_THAT(proposedByBash(folder, "exemplar mesh -"), Not(HasSubstr("--engine ")));
}

TEST(CompletionCommand, RefusesOtherShells) {
  const TestFolder folder;
  const CommandResult run = runExemplar("completion tcsh", folder.path());
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("bash"));
}

}  // namespace
}  // namespace exemplar
