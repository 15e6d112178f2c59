// SPDX-License-Identifier: MIT
// Every predictor of palpate, and the windows that they are judged by.
#include "common/scene.hpp"
#include "common/windows.hpp"
#include "support/ask_program.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace limpid;
using namespace limpid::examples;
using limpid::test::ask_program;
using limpid::test::check_refused;
using limpid::test::run_program;

namespace {

Scene press(double seconds) {
  Scene scene;
  scene.force = press_like_force();
  scene.duration = from_seconds(seconds);
  scene.period = scene.delay = std::chrono::milliseconds{100};
  return scene;
}

double over_hold(const Scene& scene, PredictorKind predictor) {
  const double error = palpate(scene, predictor).prediction.total().l2;
  return error / palpate(scene, PredictorKind::hold).prediction.total().l2;
}

constexpr double rounding = 1e-11;  // 4000 steps of some 1e-16, over a thousandth of the motion

void refused(const std::string& arguments, const std::string& option) { check_refused("palpate", arguments, option); }

}  // namespace

TEST_CASE("with the true linear tissue model, replay and Smith are exact") {
  Scene scene = press(4);
  scene.estimation.known = true;
  for (const PredictorKind predictor : {PredictorKind::model, PredictorKind::replay, PredictorKind::smith}) {
    CAPTURE(std::string(name(predictor)));
    CHECK(over_hold(scene, predictor) < rounding);
  }
}

TEST_CASE("replay of the true tissue is exact however irregular samples are, and whatever is lost") {
  Scene scene = press(4);
  scene.estimation.known = true;
  scene.disturbances.sensing = {.jitter = 0.3, .loss = 0.3};
  CHECK(over_hold(scene, PredictorKind::replay) < rounding);
}

TEST_CASE("who knows the tissue knows where its wall is") {
  Scene scene = press(4);
  scene.estimation.known = true;
  scene.tissue.wall = 0.001;
  // From 100 ms back, with one step in which contact opens or closes, of first order in the tick: 1 % of hold's.
  CHECK(over_hold(scene, PredictorKind::replay) < 0.01);
}

TEST_CASE("who knows the tissue does not know what disturbs it") {
  Scene scene = press(4);
  scene.estimation.known = true;
  scene.disturbances = {.tissue = {.step = 1.3}, .step_at = 2, .sensing = {}};
  double before = 0, after = 0;
  for (const TracePoint& point : palpate(scene, PredictorKind::replay).trace) {
    (point.time < 2 ? before : after) = std::max(point.time < 2 ? before : after, point.prediction_error);
  }
  CHECK(before < 1e-6);  // m/s; Runge and Kutta's error of the disturbed truth
  CHECK(after > 1e-3);   // 30 % of hold's, some 10 mm/s
}

TEST_CASE("every predictor that learns beats hold on the built-in presses") {
  const Scene scene = press(8);
  for (const PredictorKind predictor : {PredictorKind::smith, PredictorKind::model, PredictorKind::replay,
                                        PredictorKind::curve, PredictorKind::chosen}) {
    CAPTURE(std::string(name(predictor)));
    CHECK(over_hold(scene, predictor) < 1);
  }
}

TEST_CASE("what extrapolates follows a steady press, linear to rounding") {
  Scene scene = press(4);
  scene.force = {[](Time t) { return 0.5 * in_seconds(t); }, scene.duration, "0.5 N/s"};
  for (const PredictorKind predictor :
       {PredictorKind::linear, PredictorKind::quadratic, PredictorKind::autoregressive}) {
    CAPTURE(std::string(name(predictor)));
    const PalpationResult result = palpate(scene, predictor);
    CHECK_FALSE(has(result.status, Status::fault | Status::not_finite));
    // The tissue's own motion decays at 26 1/s: by exp(-47) in the samples from 1.8 s on.
    const double late = result.trace.back().prediction_error, hold = 0.5 / 800 * 0.199;
    CHECK(late < (predictor == PredictorKind::linear ? 1e-13 : hold));
  }
}

TEST_CASE("only hold, model and ideal work where the tool's spring pulls to the base") {
  Scene scene = press(1);
  scene.spring_at_base = true;
  CHECK_THROWS_WITH_AS((void)palpate(scene, PredictorKind::replay),
                       "Scene: spring_at_base: expected hold, model or ideal, got replay", std::invalid_argument);
}

TEST_CASE("windows are whole, judged by hold's error, and listed where that is small") {
  // 14 s at 10 Hz: three windows and a rest. Hold errs by 2, 0.001 and 2, the other by half of it.
  std::vector<double> hold, half;
  for (int k = 0; k <= 140; ++k) {
    const double error = k >= 40 && k < 80 ? 1e-3 : 2;
    hold.push_back(error * error);
    half.push_back(error * error / 4);
  }
  const auto windows = windows_of(half, hold, 0.1);
  REQUIRE(windows.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(windows[i].start == 4.0 * static_cast<double>(i));
    CHECK(windows[i].ratio == doctest::Approx(0.5));
    CHECK(windows[i].judged == (i != 1));
  }
  CHECK(windows[0].hold_error == doctest::Approx(4));  // sqrt(4 s 2^2)
}

TEST_CASE("a window in which hold has no error has no ratio, and one that is not finite is infinite") {
  const std::vector<double> none(41, 0), some(41, 1), infinite(41, INFINITY);
  CHECK(std::isnan(windows_of(some, none, 0.1).front().ratio));
  CHECK_FALSE(windows_of(some, none, 0.1).front().judged);
  CHECK(windows_of(infinite, some, 0.1).front().ratio == INFINITY);
  CHECK(windows_of(std::vector<double>(20, 1), std::vector<double>(20, 1), 0.1).empty());
}

TEST_CASE("palpate lists windows of 4 s for every predictor, hold asked for or not") {
  const auto json = ask_program("palpate", "--duration 8.5 --predictor hold,linear").json;
  for (const char* predictor : {"hold", "linear"}) CHECK(json["predictors"][predictor]["windows"].size() == 2);
  for (const auto& window : json["predictors"]["hold"]["windows"]) CHECK(window["error_over_hold"] == 1.0);
  const auto alone = ask_program("palpate", "--duration 8.5 --predictor linear").json;
  CHECK(alone["predictors"]["linear"]["windows"] == json["predictors"]["linear"]["windows"]);
  CHECK(alone["predictors"]["linear"]["windows"][1]["start"] == 4.0);
  CHECK(alone["predictors"]["linear"]["windows"][1]["judged"] == true);
  CHECK_FALSE(alone["predictors"].contains("hold"));
}

TEST_CASE("palpate --predictor all runs all, and by default it runs hold, model and ideal") {
  CHECK(ask_program("palpate", "--duration 1 --predictor all").json["predictors"].size() == 10);
  const auto predictors = ask_program("palpate", "--duration 1").json["predictors"];
  CHECK(predictors.size() == 3);
  for (const char* predictor : {"hold", "model", "ideal"}) CHECK(predictors.contains(predictor));
}

TEST_CASE("palpate's options of disturbances reach the run, and zeros do not") {
  const auto errors = [](const std::string& options) {
    return ask_program("palpate", "--duration 1.5 --predictor quadratic " + options)
        .json["predictors"]["quadratic"]["prediction_error"];
  };
  const auto clean = errors("");
  CHECK(errors("--force-noise 0 --state-noise 0,0 --quantise 0,0 --stiffness-step 1,1 --soften 0 --jitter 0 --loss 0 "
               "--relaxation 0,0.3 --depth-damping 0 --coulomb 0 --seed 5") == clean);
  for (const char* option : {"--force-noise 0.01", "--state-noise 0,1e-4", "--state-noise 1e-6,0", "--quantise 1e-5,0",
                             "--quantise 0,0.01", "--stiffness-step 0.2,1.3", "--soften 0.02", "--jitter 0.2",
                             "--loss 0.3", "--relaxation 200,0.3", "--depth-damping 1e4", "--coulomb 0.1",
                             "--wall 0.0005", "--environment exponential", "--environment layered"}) {
    CAPTURE(option);
    CHECK(errors(option) != clean);
  }
  CHECK(errors("--force-noise 0.01 --seed 3") == errors("--force-noise 0.01 --seed 3"));
  CHECK(errors("--force-noise 0.01 --seed 3") != errors("--force-noise 0.01 --seed 4"));
}

TEST_CASE("palpate says what disturbed its run, and nothing where nothing did") {
  CHECK_FALSE(ask_program("palpate", "--duration 1 --predictor hold").json["settings"].contains("disturbances"));
  const auto settings =
      ask_program("palpate", "--duration 1 --predictor hold --coulomb 0.1 --loss 0.05 --wall 0.001 --seed 9")
          .json["settings"];
  CHECK(settings["disturbances"]["coulomb"] == 0.1);
  CHECK(settings["disturbances"]["loss"] == 0.05);
  CHECK(settings["disturbances"]["seed"] == 9);
  CHECK(settings["wall"] == 0.001);
}

TEST_CASE("palpate refuses disturbances that it cannot make, and names them") {
  for (const char* arguments : {"--force-noise -1",
                                "--force-noise loud",
                                "--state-noise 1e-6",
                                "--state-noise 1e-6,-1",
                                "--quantise 1,2,3",
                                "--quantise nan,0",
                                "--stiffness-step 1",
                                "--stiffness-step 30,1.3",
                                "--stiffness-step 1,-1",
                                "--soften -0.1",
                                "--soften 0.05",
                                "--jitter 0.6",
                                "--jitter -0.1",
                                "--loss 1",
                                "--loss -0.1",
                                "--relaxation 200",
                                "--relaxation 200,0",
                                "--depth-damping -1",
                                "--coulomb -1",
                                "--coulomb inf",
                                "--wall -1",
                                "--wall 2",
                                "--seed -1",
                                "--seed 1.5",
                                "--seed 5000000000"}) {
    const std::string text = arguments;
    refused(text, text.substr(0, text.find(' ')));
  }
}

TEST_CASE("palpate says what it accepts and what it got") {
  const auto says = [](const std::string& arguments) { return run_program("palpate", arguments).output; };
  const auto refusal = [&](const std::string& arguments, const std::string& text) {
    const std::string output = says(arguments);
    CAPTURE(output);
    CHECK(output.find(text) != std::string::npos);
  };
  refusal("--jitter 0.6", "--jitter: accepts a number in [0, 0.5], got 0.6");
  refusal("--seed 1.5", "--seed: accepts a whole number of [0, 4294967295], got 1.5");
  refusal("--soften 0.05",
          "--soften: accepts a rate below 0.05 per s, at which the stiffness would be gone at the end, got 0.05");
  refusal("--stiffness-step 30,1.3", "--stiffness-step: accepts an instant within the 20 s of the run, got 30");
  refusal("--environment layered --stiffness 1,2",
          "--stiffness: accepts K1,K2,K3 with --environment layered, got two numbers");
  refusal("--predictor chosen --sample-period 0.3",
          "--sample-period, --delay: accepts at most 500 ticks, 0.5 s, together with --predictor chosen, got 0.6 s");
}

TEST_CASE("palpate refuses parameters of another tissue, and names them") {
  refused("--amplitude 1", "--amplitude");
  refused("--growth 100 --environment layered", "--growth");
  refused("--boundaries 0.001,0.002", "--boundaries");
  refused("--environment layered --boundaries 0.002,0.001", "--boundaries");
  refused("--environment layered --boundaries 0.002", "--boundaries");
  refused("--environment layered --stiffness 1,2", "--stiffness");
  refused("--environment exponential --stiffness 800", "--stiffness");
  refused("--environment exponential --growth 0", "--growth");
  refused("--stiffness 1,2,3", "--stiffness");
}

TEST_CASE("palpate refuses what a predictor cannot serve, and names it") {
  refused("--predictor curve --tool 0.1,0.1,5", "--tool");
  refused("--predictor all --tool 0.1,0.1,5", "--tool");
  refused("--predictor chosen --sample-period 0.3", "--sample-period");
  refused("--predictor replay --gain 1,2", "--gain");
  refused("--predictor curve --known", "--known");
  refused("--predictor linear --start 1100,30", "--start");
}
