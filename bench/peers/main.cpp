// SPDX-License-Identifier: MIT
// What limpid's functions of a robot cost beside those of Orocos KDL and Pinocchio, on the same arm at the same random
// motions, in turns within one run: `peers [SEED]`. A time counts only where the results are equal. Returns 1 where
// some differ, or where the Omni's take more than is asked; the chain of six joints is shown beside it.
#include "peers/function.hpp"

#include <support/maximum.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace limpid::bench;

constexpr int motions_in_all = 256, turns = 200;
constexpr double asked_times = 4, asked_difference = 1e-10, turn_ns = 20e3;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double ns_of(const Function& function, int passes) {
  const auto start = std::chrono::steady_clock::now();
  for (int pass = 0; pass < passes; ++pass) function.at_all();
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

int passes_of_a_turn(const Function& function) {
  int passes = 1;
  while (ns_of(function, passes) < turn_ns) passes *= 2;
  return passes;
}

/// Of each function and turn, ns a call.
std::vector<std::vector<double>> time_in_turns(const std::vector<const Function*>& functions) {
  std::vector<int> passes;
  for (const Function* function : functions) passes.push_back(passes_of_a_turn(*function));
  std::vector<std::vector<double>> ns(functions.size());
  for (int turn = 0; turn < turns; ++turn) {
    for (std::size_t i = 0; i < functions.size(); ++i) {
      ns[i].push_back(ns_of(*functions[i], passes[i]) / (passes[i] * motions_in_all));
    }
  }
  return ns;
}

/// Largest over all motions, over the largest entry.
double difference(const Function& theirs, const Function& ours) {
  double difference = 0, largest = 0;
  for (std::size_t i = 0; i < motions_in_all; ++i) {
    const Eigen::MatrixXd expected = ours.at(i);
    largest = limpid::test::maximum(largest, limpid::test::largest_entry(expected));
    difference = limpid::test::maximum(difference, limpid::test::largest_entry(theirs.at(i) - expected));
  }
  return difference / largest;
}

struct Verdict {
  bool equal = true;
  double fewest_times = HUGE_VAL;
};

using Functions = std::vector<Function>;

const Function* named(const Functions& functions, const std::string& name) {
  const auto found = std::find_if(functions.begin(), functions.end(), [&](const auto& f) { return f.name == name; });
  return found == functions.end() ? nullptr : &*found;
}

/// One function of limpid beside the same of the peers that have it.
void compare(const Function& ours, const std::vector<Functions>& peers, Verdict& verdict) {
  std::vector<const Function*> timed{&ours};
  for (const Functions& peer : peers) {
    if (const Function* const theirs = named(peer, ours.name)) timed.push_back(theirs);
  }
  const auto ns = time_in_turns(timed);
  std::printf("%-20s %10.1f", ours.name.c_str(), median(ns[0]));
  std::size_t next = 1;
  for (const Functions& peer : peers) {
    const Function* const theirs = named(peer, ours.name);
    if (!theirs) {
      std::printf(" | %13s %20s", "-", "");
      continue;
    }
    std::vector<double> times;
    for (std::size_t turn = 0; turn < turns; ++turn) times.push_back(ns[next][turn] / ns[0][turn]);
    const double far = difference(*theirs, ours);
    std::printf(" | %13.1f %6.1f times %7.0e", median(ns[next]), median(times), far);
    verdict.equal = verdict.equal && far <= asked_difference;
    verdict.fewest_times = std::min(verdict.fewest_times, median(times));
    ++next;
  }
  std::printf("\n");
}

Verdict compare(const ArmModel& model, unsigned seed, const std::vector<Peer>& peers, auto&& limpid_functions) {
  const std::vector<Motion> motions = random_motions(model, seed, motions_in_all);
  std::printf("\n%s\n%-20s %10s", model.name.c_str(), "", "limpid, ns");
  std::vector<Functions> theirs;
  for (const Peer& peer : peers) {
    theirs.push_back(peer.functions(model, motions));
    std::printf(" | %13s %12s %7s", (peer.name + ", ns").c_str(), "takes", "differs");
  }
  std::printf("\n");
  Verdict verdict;
  for (const Function& ours : limpid_functions(model, motions)) compare(ours, theirs, verdict);
  return verdict;
}

}  // namespace

int main(int argc, char** argv) {
  const unsigned seed = argc > 1 ? static_cast<unsigned>(std::strtoul(argv[1], nullptr, 10)) : 1;
  std::vector<Peer> peers;
  for (const Peer& peer : {kdl(), pinocchio()}) {
    if (peer.absent.empty()) {
      peers.push_back(peer);
    } else {
      std::printf("%s %s: skipped\n", peer.name.c_str(), peer.absent.c_str());
    }
  }
  if (peers.empty()) return 0;
  std::printf("medians of %d turns over %d random motions, seed %u; differences over the largest entry\n", turns,
              motions_in_all, seed);
  const Verdict omni = compare(omni_model(), seed, peers, limpid_omni);
  const Verdict chain = compare(puma_model(), seed, peers, limpid_chain);
  const bool equal = omni.equal && chain.equal, fast = omni.fewest_times >= asked_times;
  std::printf(
      "\nresults equal to %.0e: %s\nasked of the Omni: at most 1/4 of the peer's time; each takes at least %.1f "
      "times ours: %s\nthe chain of six joints: at least %.1f times\n",
      asked_difference, equal ? "yes" : "NO", omni.fewest_times, fast ? "met" : "MISSED", chain.fewest_times);
  return equal && fast ? 0 : 1;
}
