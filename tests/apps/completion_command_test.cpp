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
using testing::StartsWith;

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

bool isThere(const std::string& shell) {
  return std::system(("command -v " + shell + " >/dev/null 2>&1").c_str()) == 0;
}

/// What a line of a shell prints, run in a folder with the completions in `completion`, and "end".
std::string printedBy(const TestFolder& folder, const std::string& line) {
  const std::string quiet =
      "cd '" + folder.path().string() + "' && " + line + " > printed 2>&1 && echo end >> printed";
  return std::system(quiet.c_str()) == 0 ? readFile(folder / "printed") : "failed";
}

TEST(CompletionCommand, FishProposesWhatMayFollow) {
  if (!isThere("fish")) GTEST_SKIP() << "fish is not there";
  const TestFolder folder;
  writeFile(folder / "completion", runExemplar("completion fish", folder.path()).out);
  const auto proposed = [&](const std::string& words) {
    return printedBy(folder, "HOME=. fish -c 'source completion; complete -C \"" + words + "\"'");
  };
  EXPECT_THAT(proposed("exemplar rend"), StartsWith("render\t"));
  EXPECT_THAT(proposed("exemplar synth --engi"), StartsWith("--engine\t"));
  EXPECT_THAT(proposed("exemplar synth --engine quil"), StartsWith("quilting"));
  EXPECT_THAT(proposed("exemplar synth chainm"), StartsWith("chainmail"));
  EXPECT_EQ(proposed("exemplar mesh --engi"), "end\n");
}

TEST(CompletionCommand, ZshKnowsTheCommand) {
  if (!isThere("zsh")) GTEST_SKIP() << "zsh is not there";
  const TestFolder folder;
  writeFile(folder / "completion", runExemplar("completion zsh", folder.path()).out);
  EXPECT_EQ(printedBy(folder,
                      "zsh -fc 'autoload -Uz compinit && compinit -D -u && . ./completion && "
                      "print -- $_comps[exemplar]'"),
            "_exemplar\nend\n");
  writeFile(folder / "completion", "_exemplar() { case $1 in");
  EXPECT_EQ(printedBy(folder, "zsh -n completion"), "failed") << "what zsh cannot read is found";
}

TEST(CompletionCommand, RefusesOtherShells) {
  const TestFolder folder;
  const CommandResult run = runExemplar("completion tcsh", folder.path());
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("bash"));
}

}  // namespace
}  // namespace exemplar
