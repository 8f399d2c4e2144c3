// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "results/writers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <clocale>
#include <cmath>
#include <limits>
#include <locale>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "io/files.h"
#include "io/trajectory_file.h"
#include "results/summary.h"
#include "sample_record.h"

namespace slambench {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::sample_record;

/// What the schema says against a document; empty when it is valid.
std::string schema_errors(const json& document) {
  using Adapter = valijson::adapters::NlohmannJsonAdapter;
  const json text = json::parse(read_file(SLAMBENCH_DOCS_DIR "/record.schema.json"));
  valijson::Schema schema;
  valijson::SchemaParser().populateSchema(Adapter(text), schema);
  valijson::ValidationResults results;
  if (valijson::Validator().validate(schema, Adapter(document), &results)) return {};
  std::string all;
  for (valijson::ValidationResults::Error error; results.popError(error);) {
    for (const auto& part : error.context) all += part;
    all += ": " + error.description + "\n";
  }
  return all;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  if (text.ends_with(separator)) parts.emplace_back();
  return parts;
}

/// The field of a row (0: the first frame) in a column of frames.csv.
std::string field(const std::string& csv, std::size_t row, const std::string& column) {
  auto lines = split(csv, '\n');
  for (auto& line : lines) {
    if (line.ends_with('\r')) line.pop_back();
  }
  const auto names = split(lines.at(0), ',');
  const auto found = std::find(names.begin(), names.end(), column);
  if (found == names.end()) return "no column " + column;
  return split(lines.at(row + 1), ',').at(static_cast<std::size_t>(found - names.begin()));
}

TEST(RecordJson, FollowsItsSchema) {
  EXPECT_EQ(schema_errors(json::parse(record_json(sample_record()))), "");
}

TEST(RecordJson, OfNothingFollowsItsSchemaAndIsNoSuccess) {
  const json document = json::parse(record_json(Record{}));
  EXPECT_EQ(schema_errors(document), "");
  EXPECT_EQ(document["valid"], false);
  EXPECT_THAT(document["invalid_reasons"].dump(), HasSubstr("no frame was processed"));
}

TEST(RecordJson, TheSchemaRefusesOtherDocuments) {
  const json good = json::parse(record_json(sample_record()));
  const auto broken = [&](const char* pointer, const json& value) {
    json document = good;
    document[json::json_pointer(pointer)] = value;
    return schema_errors(document);
  };
  EXPECT_THAT(broken("/schema_version", 1), Not(IsEmpty()));
  EXPECT_THAT(broken("/surprise", 1), Not(IsEmpty()));
  EXPECT_THAT(broken("/time/fps_wall", "fast"), Not(IsEmpty()));
  EXPECT_THAT(broken("/time/kernels/track/calls", 0), Not(IsEmpty()));
  EXPECT_THAT(broken("/time/stages/track/seconds/mode", 1), Not(IsEmpty()));
  EXPECT_THAT(broken("/valid", false), Not(IsEmpty())) << "invalid without a reason";
  EXPECT_THAT(broken("/invalid_reasons", {"why"}), Not(IsEmpty())) << "valid with a reason";
  EXPECT_THAT(broken("/accuracy/over_processed/ate_m/sim2", 1), Not(IsEmpty()));
  json without = good;
  without["provenance"].erase("commit");
  EXPECT_THAT(schema_errors(without), Not(IsEmpty())) << "success without provenance";
}

/// Names of all properties that a schema declares.
void collect_properties(const json& schema, std::set<std::string>* found) {
  if (schema.is_object() && schema.contains("properties")) {
    for (const auto& property : schema["properties"].items()) found->insert(property.key());
  }
  if (!schema.is_structured()) return;
  for (const auto& part : schema) collect_properties(part, found);
}

TEST(RecordJson, EveryFieldIsExplained) {
  const std::string page = read_file(SLAMBENCH_DOCS_DIR "/record.md");
  std::set<std::string> properties;
  collect_properties(json::parse(read_file(SLAMBENCH_DOCS_DIR "/record.schema.json")), &properties);
  EXPECT_GT(properties.size(), 60u);
  for (const auto& property : properties) {
    // Figures of every statistic, sizes and cameras go without saying.
    static const std::set<std::string> plain = {"count",  "mean", "median", "p95",  "p99",
                                                "min",    "max",  "std",    "rmse", "width",
                                                "height", "fx",   "fy",     "cx",   "cy"};
    if (plain.contains(property)) continue;
    EXPECT_NE(page.find(property), std::string::npos) << property;
  }
}

TEST(RecordJson, HoldsTheFigures) {
  const json document = json::parse(record_json(sample_record()));
  EXPECT_EQ(document["format"], "slambench-record");
  EXPECT_EQ(document["valid"], true);
  EXPECT_EQ(document["provenance"]["commit"], "0123456789abcdef-dirty");
  EXPECT_EQ(document["parameters"]["kinectfusion"]["volume-size"],
            json({{"value", "5,5,5"}, {"unit", "m"}, {"set_by", "command line"}}));
  EXPECT_EQ(document["sequence"]["own_from_camera"], json::parse("[[1,0,0],[0,-1,0],[0,0,1]]"));
  EXPECT_EQ(document["frames"]["untracked_frames"], json::parse("[[0,0],[3,3]]"));
  EXPECT_EQ(document["frames"]["lost_frames"], json::parse("[[3,3]]"));
  EXPECT_EQ(document["frames"]["dropped"], 1);
  EXPECT_EQ(document["time"]["warmup_frames"], json::parse("[[0,0]]"));
  EXPECT_DOUBLE_EQ(document["time"]["fps_computation"].get<double>(), 0.8);
  EXPECT_EQ(document["time"]["start_up"]["kernels"],
            json::parse(R"({"init_volume": {"seconds": 0.25, "calls": 1}})"));
  EXPECT_FALSE(document["time"]["kernels"].contains("solve")) << "never called";
  EXPECT_EQ(document["memory"]["map_bytes"], 64 << 20);
  EXPECT_EQ(document["accuracy"]["over_processed"]["ate_m"]["se3"]["rmse"], 0.001);
  EXPECT_EQ(document["accuracy"]["slambench1_ate_m"]["mean"], 0.0207);
  EXPECT_EQ(document["memory"]["map"], "bricks");
  EXPECT_EQ(document["provenance"]["threads"], 3);
  EXPECT_EQ(document["provenance"]["instruction_set"], "AVX2");
  EXPECT_EQ(document["provenance"]["load_average_start"], 0.25);
  EXPECT_EQ(document["provenance"]["load_average_end"], 1.5);
  EXPECT_EQ(document["sequence"]["ground_truth_hash"], "ffeeddccbbaa99887766554433221100");
  EXPECT_EQ(document["time"]["kernels"]["track"]["seconds_per_frame"], 8 / 3.0 / 16);
  EXPECT_EQ(document["time"]["kernels"]["track"]["seconds"]["count"], 3);
  EXPECT_EQ(document["absent"],
            (json{{"counters", "no permission"},
                  {"energy.rails.dram", "No such file or directory"},
                  {"memory.device_bytes", "computes in host memory"},
                  {"repetition.figures.time.kernels.reduce.seconds_per_frame",
                   "not measured in every run"},
                  {"time.between_stages", "no frame was computed in one go: stages are all"},
                  {"time.transfers", "none was measured: backends in host memory have none"}}));
}

TEST(RecordJson, HoldsWhatTheMetersRead) {
  const json document = json::parse(record_json(sample_record()));
  EXPECT_EQ(document["memory"]["peak_resident_bytes"], 512 << 20);
  EXPECT_EQ(document["memory"]["resident_bytes"], 256 << 20);
  EXPECT_EQ(document["conditions"]["others_load"], 0.25);
  EXPECT_EQ(document["conditions"]["governor"], "powersave");
  EXPECT_EQ(document["conditions"]["noise"], json({"the governor is powersave"}));
  EXPECT_EQ(document["sampling"], json::parse(R"({"interval_s": 0.0625, "samples": 257,
                                                 "cpu_s": 0.5, "share_of_run": 0.03125})"));
  const json& energy = document["energy"];
  EXPECT_EQ(energy["seconds"], 16);
  EXPECT_EQ(energy["frames"], 4);
  EXPECT_EQ(energy["idle_seconds"], 8);
  EXPECT_EQ(energy["rails"]["package-0"], json::parse(R"({
      "sensor": "powercap intel-rapl:0", "reads": "energy", "in_total": true,
      "resolution_j": 1e-6, "updates": 256, "joules": 64, "joules_per_frame": 16, "mean_w": 4,
      "peak_w": 8, "idle_w": 1, "joules_above_idle": 48, "energy_delay_js": 64,
      "frames_per_joule": 0.0625})"));
  EXPECT_EQ(energy["total"]["joules"], 64);
}

TEST(RecordJson, TellsARailThatIsWithinAnotherAndReadsPower) {
  Record record = sample_record();
  RailEnergy& rail = record.measurements.energy->rails[0];
  rail.reads = "power";
  rail.within = "VDD_IN";
  rail.in_total = false;
  record.measurements.energy->total.reset();
  const json document = json::parse(record_json(record));
  EXPECT_EQ(schema_errors(document), "");
  const json& energy = document["energy"];
  EXPECT_EQ(energy["rails"]["package-0"]["resolution_w"], 1e-6);
  EXPECT_FALSE(energy["rails"]["package-0"].contains("resolution_j"));
  EXPECT_EQ(energy["rails"]["package-0"]["within"], "VDD_IN");
  EXPECT_FALSE(energy.contains("total"));
}

TEST(RecordJson, HoldsTheCountersOfEachStage) {
  Record record = sample_record();
  CounterMeasurement counters;
  counters.frames = 4;
  counters.stages[static_cast<std::size_t>(Stage::track)] = {100, 250, std::nullopt, 7};
  record.measurements.counters = counters;
  const json document = json::parse(record_json(record));
  EXPECT_EQ(schema_errors(document), "");
  EXPECT_EQ(document["counters"]["stages"]["track"],
            json::parse(R"({"cycles": 100, "instructions": 250, "branch_misses": 7})"));
}

TEST(RecordJson, HoldsHowFiguresVariedOverTheRuns) {
  const json document = json::parse(record_json(sample_record()));
  const json& repetition = document["repetition"];
  EXPECT_EQ(repetition["runs"], 3);
  EXPECT_EQ(repetition["warmup_runs"], 1);
  EXPECT_EQ(repetition["shown_run"], 2);
  EXPECT_EQ(repetition["same_trajectory"], false);
  EXPECT_EQ(repetition["other_trajectory"], json({3}));
  EXPECT_EQ(repetition["figures"]["time.computation_s.mean"],
            json::parse(R"({"unit": "s", "values": [1, 1.25, 2], "median": 1.25, "low": 1,
                            "high": 2, "run_spread": 0.5, "frame_spread": 0.25})"));
}

TEST(RecordJson, NumbersReadBackExactly) {
  Record record = sample_record();
  record.wall_s = 0.1 + 0.2;
  record.over_processed->ate_m["se3"].mean = std::numeric_limits<double>::denorm_min();
  record.over_processed->ate_m["se3"].max = 1.0 / 3;
  const json document = json::parse(record_json(record));
  EXPECT_EQ(document["time"]["wall_s"].get<double>(), 0.1 + 0.2);
  const json& se3 = document["accuracy"]["over_processed"]["ate_m"]["se3"];
  EXPECT_EQ(se3["mean"].get<double>(), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(se3["max"].get<double>(), 1.0 / 3);
}

TEST(RecordJson, WhatIsMissingHasAReason) {
  Record record = sample_record();
  record.over_processed.reset();
  record.over_all->rpe_rotation_deg = {};
  record.slambench1_ate_m.reset();
  record.absent["accuracy.over_processed"] = "the sequence has no ground truth";
  record.warmup_frames = 4;
  const json document = json::parse(record_json(record));
  EXPECT_EQ(schema_errors(document), "");
  const json& absent = document["absent"];
  EXPECT_EQ(absent["accuracy.over_processed"], "the sequence has no ground truth");
  EXPECT_EQ(absent["accuracy.over_all.rpe_rotation_deg"], "no pair of poses");
  EXPECT_EQ(absent["accuracy.slambench1_ate_m"], "not judged");
  EXPECT_EQ(absent["time.kernels"], "no frame was processed after the warm-up");
  EXPECT_FALSE(document["time"].contains("kernels"));
}

TEST(RecordJson, AStageThatNeverRanHasNoStatisticsButAReason) {
  Record record = sample_record();
  for (FrameRecord& frame : record.frames) {
    frame.times.stage_s[static_cast<std::size_t>(Stage::integrate)] = 0;
    frame.times.stage_calls[static_cast<std::size_t>(Stage::integrate)] = 0;
  }
  const json document = json::parse(record_json(record));
  EXPECT_EQ(schema_errors(document), "");
  const json& stage = document["time"]["stages"]["integrate"];
  EXPECT_EQ(stage["seconds_per_frame"], 0);
  EXPECT_FALSE(stage.contains("seconds"));
  EXPECT_EQ(document["absent"]["time.stages.integrate.seconds"], "it ran in no measured frame");
}

TEST(RecordJson, WhatIsNotFiniteIsAbsentWithAReason) {
  Record record = sample_record();
  record.over_processed->ate_m["se3"].rmse = std::nan("");
  record.frames[4].times.stage_s[0] = std::numeric_limits<double>::infinity();
  record.own_from_camera(1, 1) = std::nan("");
  const std::string text = record_json(record);
  EXPECT_THAT(text, Not(HasSubstr("null")));
  const json document = json::parse(text);
  EXPECT_EQ(schema_errors(document), "");
  EXPECT_EQ(document["valid"], false);
  EXPECT_EQ(document["absent"]["accuracy.over_processed.ate_m.se3.rmse"], "not a finite number");
  EXPECT_EQ(document["absent"]["sequence.own_from_camera"], "not a finite number");
  EXPECT_EQ(document["absent"]["time.stages.acquire.seconds.max"], "not a finite number");
  EXPECT_FALSE(document["sequence"].contains("own_from_camera"));
}

TEST(RecordJson, TakesTextThatIsNotUtf8) {
  Record record = sample_record();
  record.path = "/data/\xff\"\n";
  EXPECT_EQ(schema_errors(json::parse(record_json(record))), "");
}

TEST(RecordJson, HasWhatLiesBetweenStagesWhereFramesWereComputedInOneGo) {
  Record record = sample_record();
  const json without = json::parse(record_json(record));
  EXPECT_FALSE(without["time"].contains("between_stages"));
  EXPECT_EQ(without["absent"]["time.between_stages"],
            "no frame was computed in one go: stages are all");
  for (const std::size_t frame : {3u, 4u}) record.frames[frame].times.between_stages_s = 0.5;
  const json document = json::parse(record_json(record));
  EXPECT_EQ(schema_errors(document), "");
  const json& between = document["time"]["between_stages"];
  EXPECT_EQ(between["seconds_per_frame"], 1.0 / 3);  // of frames 1, 3 and 4
  EXPECT_EQ(between["seconds"]["count"], 2);
  EXPECT_FALSE(document["absent"].contains("time.between_stages"));
  EXPECT_EQ(document["time"]["stages"]["track"]["seconds"],
            without["time"]["stages"]["track"]["seconds"]);
  for (const char* figure : {"computation_s", "total_s"}) {
    EXPECT_DOUBLE_EQ(document["time"][figure]["mean"].get<double>(),
                     without["time"][figure]["mean"].get<double>() + 1.0 / 3);
  }
}

TEST(RecordJson, HasTransfersWhereThereWereAnyAndAddsThemToNothing) {
  Record record = sample_record();
  const json without = json::parse(record_json(record));
  EXPECT_FALSE(without["time"].contains("transfers"));
  testing::add_sample_transfers(record);
  json document = json::parse(record_json(record));
  EXPECT_EQ(schema_errors(document), "");
  const json& to_device = document["time"]["transfers"]["to_device"];
  EXPECT_EQ(to_device["seconds_per_frame"], 8 / 64.0 / 3);  // of frames 1, 3 and 4
  EXPECT_EQ(to_device["seconds"]["median"], 3 / 64.0);
  EXPECT_EQ(to_device["count_per_frame"], 1);
  EXPECT_EQ(to_device["bytes_per_frame"], 1024);
  const json& to_host = document["time"]["transfers"]["to_host"];
  EXPECT_EQ(to_host["seconds_per_frame"], 4 / 32.0 / 3);
  EXPECT_EQ(to_host["seconds"]["count"], 2);
  EXPECT_EQ(to_host["count_per_frame"], 2);
  EXPECT_EQ(to_host["bytes_per_frame"], 256);
  document["time"].erase("transfers");
  const json& reason = without["absent"]["time.transfers"];
  EXPECT_THAT(reason.get<std::string>(), HasSubstr("host memory"));
  document["absent"]["time.transfers"] = reason;
  EXPECT_EQ(document, without);
}

TEST(RecordJson, IsNoSuccessWhenTheRunIsInvalid) {
  Record record = sample_record();
  record.valid = false;
  record.invalid_reasons = {"the map is empty"};
  const json document = json::parse(record_json(record));
  EXPECT_EQ(schema_errors(document), "");
  EXPECT_EQ(document["valid"], false);
  EXPECT_EQ(document["invalid_reasons"], json({"the map is empty"}));
}

TEST(RecordJson, SaysThatARunWasInterrupted) {
  Record record = sample_record();
  record.complete = false;
  record.incomplete_reason = "interrupted by the user";
  const json document = json::parse(record_json(record));
  EXPECT_EQ(schema_errors(document), "");
  EXPECT_EQ(document["complete"], false);
  EXPECT_EQ(document["incomplete_reason"], "interrupted by the user");
}

TEST(FramesCsv, IsTheLiteralTextOfASmallRecord) {
  Record record = sample_record();
  record.frames.erase(record.frames.begin() + 3, record.frames.end());
  EXPECT_EQ(
      frames_csv(record),
      "index,time_s,dropped,warmup,tracked,integrated,x_m,y_m,z_m,qx,qy,qz,qw,"
      "error_first_pose_m,error_se3_m,inliers,inlier_fraction,residual_m,"
      "iterations_level0,iterations_level1,start_s,process_start_s,computation_s,total_s,read_s,"
      "between_stages_s,stage_acquire_s,stage_preprocess_s,stage_track_s,stage_integrate_s,stage_"
      "raycast_s,"
      "stage_render_s,kernel_acquire_s,kernel_acquire_calls,kernel_mm2meters_s,"
      "kernel_mm2meters_calls,kernel_bilateral_filter_s,kernel_bilateral_filter_calls,"
      "kernel_half_sample_s,kernel_half_sample_calls,kernel_depth2vertex_s,"
      "kernel_depth2vertex_calls,kernel_vertex2normal_s,kernel_vertex2normal_calls,"
      "kernel_track_s,kernel_track_calls,kernel_reduce_s,kernel_reduce_calls,kernel_solve_s,"
      "kernel_solve_calls,kernel_align_s,kernel_align_calls,kernel_integrate_s,"
      "kernel_integrate_calls,kernel_raycast_s,kernel_raycast_calls,kernel_render_depth_s,"
      "kernel_render_depth_calls,kernel_render_track_s,kernel_render_track_calls,"
      "kernel_render_volume_s,kernel_render_volume_calls,"
      "transfer_to_device_s,transfer_to_device_bytes,transfer_to_device_count,"
      "transfer_to_host_s,transfer_to_host_bytes,transfer_to_host_count\r\n"
      "0,0,0,1,0,1,0,0,0,0,0,0,1,,,,,,,,0,0,468.75,984.375,7.8125,,15.625,31.25,62.5,125,250,500,"
      "15.625,1,31.25,1,,0,,0,,0,,0,62.5,4,,0,,0,,0,125,1,,0,,0,,0,,0,,,0,,,0\r\n"
      "1,0.5,0,0,1,1,1,-0.25,0.5,0,0,0,1,0.0625,0.125,1000,0.5,0.001,4,3,1004,0,0.46875,0.984375,0."
      "0078125,,"
      "0.015625,0.03125,0.0625,0.125,0.25,0.5,"
      "0.015625,1,0.03125,1,,0,,0,,0,,0,0.0625,4,,0,,0,,0,0.125,1,,0,,0,,0,,0,,,0,,,0\r\n"
      "2,1,1,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,\r\n");
}

TEST(FramesCsv, TellsFramesThatWereComputedInOneGo) {
  Record record = sample_record();
  record.frames[3].times.between_stages_s = 0.5;
  const std::string csv = frames_csv(record);
  EXPECT_EQ(field(csv, 3, "between_stages_s"), "0.5");
  EXPECT_EQ(field(csv, 4, "between_stages_s"), "");
  record.frames[3].times.between_stages_s = 0;
  EXPECT_EQ(field(frames_csv(record), 3, "between_stages_s"), "0") << "measured: nothing left over";
}

TEST(FramesCsv, HasTransfersWhereThereWereAny) {
  Record record = sample_record();
  testing::add_sample_transfers(record);
  const std::string csv = frames_csv(record);
  EXPECT_EQ(field(csv, 3, "transfer_to_device_s"), "0.046875");
  EXPECT_EQ(field(csv, 3, "transfer_to_device_bytes"), "1024");
  EXPECT_EQ(field(csv, 3, "transfer_to_host_s"), "0.09375");
  EXPECT_EQ(field(csv, 3, "transfer_to_host_count"), "3");
  EXPECT_EQ(field(csv, 4, "transfer_to_host_bytes"), "");
  EXPECT_EQ(field(csv, 4, "transfer_to_host_count"), "0");
}

TEST(FramesCsv, EveryRowHasAllColumns) {
  Record record = sample_record();
  record.frames[4].iterations = {7};  // fewer levels than others
  const auto lines = split(frames_csv(record), '\n');
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(split(lines.at(i), ',').size(), split(lines.at(0), ',').size()) << "line " << i;
  }
  EXPECT_EQ(field(frames_csv(record), 4, "iterations_level0"), "7");
  EXPECT_EQ(field(frames_csv(record), 4, "iterations_level1"), "");
}

TEST(FramesCsv, HasEmptyFieldsForStagesThatDidNotRun) {
  Record record = sample_record();
  record.frames[3].times.stage_calls[static_cast<std::size_t>(Stage::integrate)] = 0;
  EXPECT_EQ(field(frames_csv(record), 3, "stage_integrate_s"), "");
  EXPECT_EQ(field(frames_csv(record), 3, "stage_raycast_s"), "0.75");
}

TEST(FramesCsv, HasEmptyFieldsForWhatIsNotFinite) {
  Record record = sample_record();
  record.frames[3].T_start_camera(0, 3) = std::nan("");
  record.frames[3].residual_m = std::numeric_limits<double>::infinity();
  const std::string csv = frames_csv(record);
  EXPECT_EQ(field(csv, 3, "x_m"), "");
  EXPECT_EQ(field(csv, 3, "qw"), "");
  EXPECT_EQ(field(csv, 3, "residual_m"), "");
  EXPECT_EQ(field(csv, 3, "inliers"), "1000");
  EXPECT_EQ(field(csv, 4, "x_m"), "4");
}

TEST(FramesCsv, GivesQuaternionsInTheSequencesOwnAxes) {
  Record record = sample_record();
  record.frames[4].T_start_camera.linear() =
      Eigen::AngleAxisd(2 * std::acos(0.6), Eigen::Vector3d::UnitX()).toRotationMatrix();
  const std::string csv = frames_csv(record);
  EXPECT_NEAR(std::stod(field(csv, 4, "qx")), -0.8, 1e-12) << "y up turns the other way about x";
  EXPECT_NEAR(std::stod(field(csv, 4, "qw")), 0.6, 1e-12);
}

TEST(SamplesCsv, HasARowAReading) {
  Record record = sample_record();
  record.measurements.sampling->series[0].name = "a, \"b\"";
  EXPECT_EQ(samples_csv(record),
            "meter,unit,time_s,value\r\n\"a, \"\"b\"\"\",W,0.0625,2\r\n"
            "\"a, \"\"b\"\"\",W,0.125,8\r\n");
  record.measurements.sampling.reset();
  EXPECT_EQ(samples_csv(record), "");
}

TEST(Slambench1Log, IsTheLiteralTextWithPositionsOneFrameLate) {
  EXPECT_EQ(slambench1_log(sample_record()),
            "frame\tacquisition\tpreprocessing\ttracking\tintegration\traycasting\trendering\t"
            "computation\ttotal\tX\tY\tZ\ttracked\tintegrated\n"
            "0\t15.625000\t31.250000\t62.500000\t125.000000\t250.000000\t500.000000\t"
            "468.750000\t984.375000\t0.000000\t0.000000\t0.000000\t0\t1\n"
            "1\t0.015625\t0.031250\t0.062500\t0.125000\t0.250000\t0.500000\t"
            "0.468750\t0.984375\t0.000000\t0.000000\t0.000000\t1\t1\n"
            "3\t0.046875\t0.093750\t0.187500\t0.375000\t0.750000\t1.500000\t"
            "1.406250\t2.953125\t1.000000\t0.250000\t0.500000\t0\t0\n"
            "4\t0.062500\t0.125000\t0.250000\t0.500000\t1.000000\t2.000000\t"
            "1.875000\t3.937500\t3.000000\t0.750000\t1.500000\t1\t0\n");
}

TEST(TrajectoryTum, IsInTheSequencesOwnAxesAndStamps) {
  EXPECT_EQ(trajectory_text(estimated_trajectory(sample_record())),
            "# time tx ty tz qx qy qz qw\n"
            "0 0 0 0 0 0 0 1\n"
            "0.5 1 -0.25 0.5 0 0 0 1\n"
            "1.5 3 -0.75 1.5 0 0 0 1\n"
            "2 4 -1 2 0 0 0 1\n");
}

TEST(ReadmeText, NamesTheRunAndItsFiles) {
  Record record = sample_record();
  const std::string text = readme_text(record, false);
  EXPECT_THAT(text, HasSubstr("SLAMBench 1.2.3 (commit 0123456789abcdef-dirty)\n"));
  EXPECT_THAT(text, HasSubstr("Sequence  kt3, 4 of 400 frames processed\n"));
  for (const char* file : {"record.json", "frames.csv", "trajectory.tum", "slambench1.log"}) {
    EXPECT_THAT(text, HasSubstr(std::string("\n  ") + file));
  }
  EXPECT_THAT(text, HasSubstr("\n  groundtruth.tum"));
  EXPECT_THAT(text, HasSubstr("evo_ape tum groundtruth.tum trajectory.tum"));
  EXPECT_THAT(text, Not(HasSubstr("images/")));
  EXPECT_THAT(text, Not(HasSubstr("INVALID")));
  EXPECT_THAT(readme_text(record, true), HasSubstr("\n  images/"));
  record.complete = false;
  record.invalid_reasons = {"why"};
  EXPECT_THAT(readme_text(record, true), HasSubstr("\nINVALID: why\n"));
  EXPECT_THAT(readme_text(record, true), HasSubstr("\nINCOMPLETE: the run was interrupted\n"));
  record.ground_truth.clear();
  EXPECT_THAT(readme_text(record, false), Not(HasSubstr("groundtruth.tum")));
}

/// A decimal comma in the C++ locale, and in the C locale where the system has such, while it
/// lives.
class DecimalComma {
 public:
  DecimalComma() : before_(std::setlocale(LC_ALL, nullptr)) {
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "nl_NL.UTF-8"}) {
      if (std::setlocale(LC_ALL, name) != nullptr) break;
    }
    std::locale::global(std::locale(std::locale::classic(), new Comma));
  }
  ~DecimalComma() {
    std::locale::global(std::locale::classic());
    std::setlocale(LC_ALL, before_.c_str());
  }

 private:
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::string before_;
};

TEST(Writers, DoNotDependOnTheLocale) {
  Record record = sample_record();
  record.wall_s = 1234567.5;
  const auto all = [&] {
    return std::array<std::string, 6>{
        record_json(record),       frames_csv(record),
        slambench1_log(record),    trajectory_text(estimated_trajectory(record)),
        readme_text(record, true), summary_text(record, "results/x", false)};
  };
  const auto expected = all();
  const DecimalComma comma;
  EXPECT_EQ(all(), expected);
}

}  // namespace
}  // namespace slambench
