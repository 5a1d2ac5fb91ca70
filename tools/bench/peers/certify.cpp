// Solves a contact problem with tabor, or proves how good somebody else's pressure field is.
//
//   bench_certify solve HEIGHTS PRESSURE PIXEL E_STAR P P_SAT TOLERANCE [THREADS]
//   bench_certify check HEIGHTS PRESSURE PIXEL E_STAR P P_SAT
//
// HEIGHTS [m] and PRESSURE [Pa] are .npy files of float64, PRESSURE written by `solve` and read by
// `check`; PIXEL [m], E_STAR, P and P_SAT [Pa]; P_SAT inf is an elastic contact. Prints one JSON
// object. Periodic cell.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "npy.hpp"
#include "tabor/contact/certificate.hpp"
#include "tabor/contact/contact.hpp"
#include "tabor/contact/projection.hpp"
#include "tabor/contact/scale.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/elastic/half_space.hpp"
#include "tabor/io/text/json.hpp"

namespace {

using namespace tabor;

struct Request {
  std::string command;
  std::string pressure_file;
  double pixel = 0;              // [m]
  double effective_modulus = 0;  // [Pa]
  double mean_pressure = 0;      // [Pa]
  contact::Problem problem;
  Grid grid;
};

Request parse(const std::vector<std::string>& words) {
  if (words.size() < 7 || (words[0] == "solve" && words.size() < 8)) {
    throw std::runtime_error("see the head of certify.cpp for the arguments");
  }
  Request request;
  request.command = words[0];
  request.pressure_file = words[2];
  request.pixel = std::stod(words[3]);
  request.effective_modulus = std::stod(words[4]);
  request.problem.height = bench::read_npy(words[1]);
  request.mean_pressure = std::stod(words[5]);
  request.problem.control = contact::MeanPressure{request.mean_pressure};
  request.problem.bounds.upper = std::stod(words[6]);
  const Field& height = request.problem.height;
  request.grid = {height.cols(), height.rows(), static_cast<double>(height.cols()) * request.pixel,
                  static_cast<double>(height.rows()) * request.pixel};
  if (request.command == "solve") {
    request.problem.tolerance = std::stod(words[7]);
    set_thread_count(words.size() > 8 ? std::stoi(words[8]) : 1);
  }
  return request;
}

/// Resident memory of this process now [bytes].
double resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  double total = 0;
  double resident = 0;
  statm >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The construction of the operator belongs to the time: every user pays it.
io::Json solve(const Request& request) {
  const double resident_before = resident_bytes();
  const double processor_before = processor_seconds();
  const Stopwatch watch;
  const auto elasticity = elastic::make_periodic(request.grid, request.effective_modulus);
  const contact::State state = contact::solve(*elasticity, request.problem);
  io::Json json;
  json["seconds"] = watch.seconds();
  json["processor_seconds"] = processor_seconds() - processor_before;
  json["peak_bytes"] = static_cast<double>(peak_memory_bytes());
  json["before_bytes"] = resident_before;
  json["iterations"] = state.convergence.iterations;
  json["fft_pairs"] = state.convergence.fft_pairs;
  json["own_error"] = io::number(state.convergence.certificate);
  json["converged"] = state.convergence.converged();
  bench::write_npy(state.pressure, request.pressure_file);
  return json;
}

double load_error(const Field& pressure, double mean_pressure) {
  return pressure.mean() / mean_pressure - 1;
}

/// The duality gap is defined for pressures that carry the load: those in contact are shifted until
/// they do, all of them where the pixels in contact cannot.
void carry_load(Field& pressure, const Request& request) {
  const double cap = request.problem.bounds.upper;
  const double load = request.mean_pressure * static_cast<double>(pressure.size());
  const auto n_contacts = static_cast<double>(contact::contact_mask(pressure).count());
  const bool all = n_contacts * cap <= load;
  const auto is_chosen = [all](double p) { return all || contact::touches(p); };
  const std::span pixels(pressure.data(), static_cast<std::size_t>(pressure.size()));
  std::vector<double> chosen;
  std::copy_if(pixels.begin(), pixels.end(), std::back_inserter(chosen), is_chosen);
  contact::project_on_load(chosen, load, cap);
  auto next = chosen.begin();
  for (double& p : pixels) p = is_chosen(p) ? *next++ : 0;
}

double certificate(const Request& request, const Field& pressure,
                   elastic::ElasticOperator& elasticity) {
  Field displacement(pressure.rows(), pressure.cols());
  elasticity.apply(pressure, displacement);
  const Field residual = displacement - request.problem.height;
  const contact::Candidates candidates{{pressure.data(), pressure.data() + pressure.size()},
                                       {residual.data(), residual.data() + residual.size()}};
  const double load = request.mean_pressure * static_cast<double>(pressure.size());
  return contact::duality_gap(candidates, load, request.problem.bounds.upper) /
         (load * contact::length_scale(
                     elasticity, contact::under_pressure(request.problem, request.mean_pressure)));
}

io::Json check(const Request& request) {
  const auto elasticity = elastic::make_periodic(request.grid, request.effective_modulus);
  Field pressure = bench::read_npy(request.pressure_file);
  if (pressure.rows() != request.grid.ny || pressure.cols() != request.grid.nx) {
    throw std::runtime_error(fmt::format("{}: {} x {} pressures, expected {} x {} as the heights",
                                         request.pressure_file, pressure.cols(), pressure.rows(),
                                         request.grid.nx, request.grid.ny));
  }
  io::Json json;
  json["contact_area"] = contact::contact_mask(pressure).cast<double>().mean();
  json["lowest_pressure_Pa"] = pressure.minCoeff();
  json["highest_pressure_Pa"] = pressure.maxCoeff();
  json["load_error"] = load_error(pressure, request.mean_pressure);
  carry_load(pressure, request);
  json["load_error_after_shift"] = load_error(pressure, request.mean_pressure);
  json["certificate"] = io::number(certificate(request, pressure, *elasticity));
  return json;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Request request = parse({argv + 1, argv + argc});
    const io::Json json = request.command == "solve" ? solve(request) : check(request);
    fmt::print("{}\n", io::to_text(json, -1));
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_certify: {}\n", error.what());
    return 1;
  }
  return 0;
}
