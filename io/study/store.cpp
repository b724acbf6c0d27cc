#include "io/study/store.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "io/atomic_file.hpp"

namespace riven::study {

namespace {

using Json = nlohmann::ordered_json;
constexpr const char* file_name = "record.json";

}  // namespace

Store::Store(std::filesystem::path folder) : folder_(std::move(folder)) {
  make_folder(folder_ / "runs");
}

std::optional<Record> Store::find(const Run& run) const {
  std::ifstream in(results(run) / file_name);
  const Json j = Json::parse(in, nullptr, false);
  if (!j.is_object())
    return std::nullopt;
  try {
    Record r;
    j.at("status").get_to(r.status);
    j.at("message").get_to(r.message);
    j.at("steps").get_to(r.steps);
    j.at("particles").get_to(r.particles);
    j.at("memory_bytes").get_to(r.memory);
    j.at("wall_seconds").get_to(r.wall);
    j.at("cpu_seconds").get_to(r.cpu);
    for (const auto& [effect, share] : j.at("shares").items())
      r.shares.emplace_back(effect, share.get<double>());
    return r;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

void Store::keep(const Run& run, const Record& record) const {
  Json j;
  j["label"] = run.label;
  j["set"] = run.set;
  j["status"] = record.status;
  j["message"] = record.message;
  j["steps"] = record.steps;
  j["particles"] = record.particles;
  j["memory_bytes"] = record.memory;
  j["wall_seconds"] = record.wall;
  j["cpu_seconds"] = record.cpu;
  j["shares"] = Json::object();
  for (const auto& [effect, share] : record.shares)
    j["shares"][effect] = share;
  write_file(results(run) / file_name, j.dump(2) + "\n");
}

}  // namespace riven::study
