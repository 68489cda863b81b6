// Every command that a document shows is run here, or covered by a test that is named here; what it names exists.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>

#include "program.hpp"
#include "shown_commands.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;

const std::filesystem::path kRoot = DEMECAL_SOURCE_DIR;
const std::string kPrograms = std::string(DEMECAL_BINARY_DIR) + "/bin";

std::string text_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// In order, run in a folder with a small job, its data set and a program.
const std::vector<std::string> kRun = {
    "demecal calibrate my-job.yaml --out my-result",
    "demecal evaluate my-result/model.yaml my-new-poses.yaml",
    "demecal certify my-result/model.yaml my-new-poses.yaml --tolerance 0.5 --out my-certificate",
    "demecal apply my-result/model.yaml my-program.v2 --out my-corrected-program.v2",
    "demecal compare configs/jobs/full.yaml --data DATASET.yaml",
};

/// What takes another machine, hours, or this one's own system: the test of the same, or the reason why there is none.
const std::map<std::string, std::string> kCovered = {
    {"demecal calibrate /usr/share/demecal/jobs/demo.yaml --out demo-result", "CalibratesItsExampleWithoutTheSource"},
    {"man demecal-calibrate", "HasProgramsPagesCompletionsConfigurationsAndTheProtocol"},
    {"cmake --install build/release --prefix /usr/local", "HasProgramsPagesCompletionsConfigurationsAndTheProtocol"},
    {"apt install ./build/package/demecal_*.deb", "scripts/package --try"},
    {"apt install ./demecal_0.1.0_amd64.deb", "scripts/package --try"},
    {"demecal-worker --network --slots 4", "BrokenLinksHealAndLeaveTheSameModelByMulticast"},
    {"demecal calibrate my-job.yaml --out my-result --workers 0 --network",
     "BrokenLinksHealAndLeaveTheSameModelByMulticast"},
    {"demecal-worker --peer 192.0.2.10 --peer 192.0.2.11 --peer 192.0.2.12",
     "HostsMeetByNamedPeersAndShowCertificates"},
    {"demecal calibrate my-job.yaml --out my-result --workers 0 --peer 192.0.2.10 --peer 192.0.2.11 --peer 192.0.2.12",
     "HostsMeetByNamedPeersAndShowCertificates"},
    {"fast-discovery-server -x configs/dds/discovery-server.xml -i 0 -l 192.0.2.10 -p 11811",
     "BrokenLinksHealAndLeaveTheSameModelByADiscoveryServer"},
    {"demecal-worker --discovery-server 192.0.2.10:11811", "BrokenLinksHealAndLeaveTheSameModelByADiscoveryServer"},
    {"demecal calibrate my-job.yaml --out my-result --workers 0 --discovery-server 192.0.2.10:11811",
     "BrokenLinksHealAndLeaveTheSameModelByADiscoveryServer"},
    {"scripts/security certificates", "SecuredCalibrationsGiveTheSameModel"},
    {"demecal calibrate my-job.yaml --out my-result --workers 0 --network --security certificates",
     "HostsMeetByNamedPeersAndShowCertificates"},
    {"demecal-worker --network --security certificates", "HostsMeetByNamedPeersAndShowCertificates"},
    {"demecal monitor --network --security certificates", "SecuredCalibrationsGiveTheSameModel"},
    {"scripts/workers start --network", "StartHereWithASlotPerCoreAreListedAndStop"},
    {"scripts/workers start --per-core --network", "ADryRunPrintsCommandsOnePerCoreWhereAskedAndDoesNothing"},
    {"scripts/workers start --hosts hosts.txt --programs /usr/local/bin --discovery-server 192.0.2.10:11811",
     "StartOnEveryHostOfAListServeACoordinatorAndStop"},
    {"scripts/workers status --hosts hosts.txt", "StartOnEveryHostOfAListServeACoordinatorAndStop"},
    {"scripts/workers stop --hosts hosts.txt", "StartOnEveryHostOfAListServeACoordinatorAndStop"},
    {"demecal study configs/jobs/shared-functions.yaml --out study --grid configs/grids/shared-functions.yaml",
     "PrintsATableAndLeavesEveryRun"},
    {"demecal study configs/jobs/demo.yaml --set method=direct,diagnose --closed-loop --out study",
     "ComparesEvolutionAndTheClosedLoopAlone"},
    {"ctest --preset release -L applied", "scripts/test"},
    {"build/release/bin/test_acceptance --gtest_filter=Verdict.*", "ProvesWhatIsNotTrueAtMostAsOftenAsIsSaid"},
    {"systemctl enable --now demecal-worker", "TheSystemdUnitStartsAWorkerWithTheOptionsOfItsFile"},
    {"echo 'OPTIONS=--discovery-server 192.0.2.10:11811' > /etc/default/demecal-worker",
     "TheSystemdUnitStartsAWorkerWithTheOptionsOfItsFile"},
    {"adduser --system --group demecal", "the system's own"},
    {"install -d -o demecal -m 700 /etc/demecal", "the system's own"},
    {"install -o demecal -m 600 certificates/authority.pem certificates/governance.p7s certificates/worker.* "
     "/etc/demecal/",
     "the system's own"},
    {"sysctl net.core.rmem_max=4194304 net.core.wmem_max=4194304", "the system's own"},
};

/// The help of a program, of its command where it has one, or of a script.
std::string help_of(const std::string& command) {
  static std::map<std::string, std::string> known;
  std::smatch words;
  std::regex_search(command, words, std::regex("^(\\S+)(?: (robot [a-z]+|[a-z]+)\\b)?"));
  const bool script = words[1].str().starts_with("scripts/");
  const std::string call = script                        ? (kRoot / words[1].str()).string()
                           : words[1].str() == "demecal" ? kPrograms + "/demecal " + words[2].str()
                                                         : kPrograms + "/" + words[1].str();
  if (!known.contains(call)) {
    const Ended ended = run("/bin/sh", {"-c", call + " --help"});
    EXPECT_EQ(ended.code, 0) << command;
    known[call] = ended.out + ended.err;
  }
  if (words[1].str() != "scripts/bench" || !words[2].matched) return known[call];
  // Benchmarks take the options of their programs, which are built when they are run.
  std::smatch bench;
  std::regex_search(command, bench, std::regex("^\\S+ ([a-z-]+)"));
  std::string folder = bench[1].str();
  std::ranges::replace(folder, '-', '_');
  return known[call] + text_of_file(kRoot / "tests/bench" / folder / "main.cpp");
}

bool is_of_the_project(const std::string& command) {
  return std::regex_search(command, std::regex("^(demecal|demecal-worker|scripts/[a-z0-9-]+)( |$)"));
}

std::vector<ShownCommand> all(std::vector<ShownCommand> (*find)(const std::string&, const std::string&)) {
  std::vector<ShownCommand> commands;
  for (const std::string& document : documents()) {
    const std::vector<ShownCommand> found = find(document, text_of_file(kRoot / document));
    commands.insert(commands.end(), found.begin(), found.end());
  }
  return commands;
}

bool is_a_test(const std::string& name) {
  static const std::string sources = [] {
    std::string text;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / "tests")) {
      const bool itself = entry.path().filename() == "documents_test.cpp";
      if (entry.path().extension() == ".cpp" && !itself) text += text_of_file(entry.path());
    }
    return text;
  }();
  return sources.find(", " + name + ")") != std::string::npos;
}

TEST(Commands, ShownInDocumentsAreRunOrCovered) {
  for (const ShownCommand& command : all(shown_commands)) {
    const bool script = command.text.starts_with("scripts/");
    const bool ran = std::ranges::find(kRun, command.text) != kRun.end();
    EXPECT_TRUE(ran || kCovered.contains(command.text) || script)
        << command.document << ":" << command.line << ": neither run nor covered: " << command.text;
  }
}

TEST(Commands, ThatAreCoveredHaveTheTestThatIsNamed) {
  std::set<std::string> shown;
  for (const ShownCommand& command : all(shown_commands)) shown.insert(command.text);
  for (const auto& [command, test] : kCovered) {
    EXPECT_THAT(shown, Contains(command)) << "no document shows it any more";
    const bool is_named = test.find(' ') == std::string::npos && !test.starts_with("scripts/");
    EXPECT_TRUE(!is_named || is_a_test(test)) << test << " is no test";
  }
}

TEST(Commands, ShownInDocumentsRunAsTheyStand) {
  SmallJob job;
  namespace fs = std::filesystem;
  const fs::path folder = job.path("documents");
  fs::create_directory(folder);
  for (const char* const file : {"poses.csv", "robot.yaml"})
    fs::copy(job.path("data/" + std::string(file)), folder / file);
  for (const char* const name : {"my-new-poses.yaml", "DATASET.yaml"}) fs::copy(job.data(), folder / name);
  std::ofstream(folder / "my-job.yaml") << std::regex_replace(text_of_file(job.job()), std::regex("data/dataset.yaml"),
                                                              "DATASET.yaml");
  fs::copy(kRoot / "configs/preparation/calibration.v2", folder / "my-program.v2");
  fs::create_directory_symlink(kRoot / "configs", folder / "configs");
  for (const std::string& command : kRun) {
    const std::string call = "cd " + folder.string() + " && export PATH=" + kPrograms +
                             ":$PATH DEMECAL_DOMAIN=" + private_domain() + " && " + command;
    const Ended ended = StartedProgram("/bin/sh", {"-c", call}).wait(std::chrono::seconds(300));
    EXPECT_EQ(ended.code, 0) << command << "\n" << ended.err;
  }
}

TEST(Commands, HaveTheOptionsThatDocumentsName) {
  std::vector<ShownCommand> commands = all(shown_commands);
  const std::vector<ShownCommand> mentioned = all(mentioned_commands);
  commands.insert(commands.end(), mentioned.begin(), mentioned.end());
  for (const ShownCommand& command : commands) {
    if (!is_of_the_project(command.text)) continue;
    if (command.text.starts_with("scripts/")) {
      const std::string script = command.text.substr(0, command.text.find(' '));
      ASSERT_TRUE(std::filesystem::exists(kRoot / script)) << command.document << ":" << command.line;
    }
    const std::string help = help_of(command.text);
    for (const std::string& option : options_of(command)) {
      const bool passed_on = command.text.starts_with("scripts/workers") && help.find(option) == std::string::npos;
      const std::string& says = passed_on ? help_of("demecal-worker") : help;
      EXPECT_NE(says.find(option), std::string::npos)
          << command.document << ":" << command.line << ": " << command.text << " has no " << option;
    }
  }
}

TEST(Documents, LinkOnlyToWhatIsThere) {
  const std::regex link("\\]\\(([^)#]+)(#[^)]*)?\\)");
  for (const std::string& document : documents()) {
    const std::string text = text_of_file(kRoot / document);
    for (std::sregex_iterator match(text.begin(), text.end(), link), end; match != end; ++match) {
      const std::string target = (*match)[1].str();
      if (target.find("://") != std::string::npos) continue;
      EXPECT_TRUE(std::filesystem::exists((kRoot / document).parent_path() / target)) << document << ": " << target;
    }
  }
}

TEST(Documents, ArchitectureNamesFilesThatAreThereAndEveryRoom) {
  const std::string text = text_of_file(kRoot / "docs/ARCHITECTURE.md");
  const std::regex header("`([a-z_]+/[a-z_]+\\.hpp)`");
  for (std::sregex_iterator match(text.begin(), text.end(), header), end; match != end; ++match)
    EXPECT_TRUE(std::filesystem::exists(kRoot / "common" / (*match)[1].str())) << (*match)[1].str();
  for (const auto& entry : std::filesystem::directory_iterator(kRoot / "common")) {
    if (!entry.is_directory()) continue;
    const std::string room = entry.path().filename().string();
    EXPECT_NE(text.find("\n| `" + room + "` |"), std::string::npos) << "its room map lacks " << room;
  }
}

TEST(Documents, ShowTheProgramThatATestBuilds) {
  const std::string program = text_of_file(kRoot / "tests/consumer/consumer.cpp");
  const std::string shown = program.substr(program.find('\n') + 1);
  EXPECT_NE(text_of_file(kRoot / "README.md").find(shown), std::string::npos);
}

TEST(ShownCommands, AreTheLinesOfShellBlocksWithoutComments) {
  const std::string text = "`demecal report DIR`\n```sh\ndemecal report DIR  # again\n```\n```\nan output\n```\n";
  const std::vector<ShownCommand> shown = shown_commands("a.md", text);
  ASSERT_EQ(shown.size(), 1U);
  EXPECT_EQ(shown[0].text, "demecal report DIR");
  EXPECT_EQ(shown[0].line, 3U);
  ASSERT_EQ(mentioned_commands("a.md", text).size(), 1U);
  EXPECT_THAT(options_of({"a.md", 1, "demecal apply M P --out F [--strict] --tool-mm 1 -2 3"}),
              ElementsAre("--out", "--strict", "--tool-mm"));
}

}  // namespace
}  // namespace demecal
