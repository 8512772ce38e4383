// A fixed source that the reference benchmark compiles: headers of the libraries that cost most.
// Do not change it: times of other machines and commits are compared by it.

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <Eigen/Dense>
#include <fmt/format.h>

int main(int count, char** words) {
  CLI::App program("least squares");
  std::map<std::string, double> given;
  int rows = 8;
  program.add_option("--rows", rows);
  program.add_option("--value", given);
  CLI11_PARSE(program, count, words);
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(rows, 4);
  const Eigen::VectorXd b = Eigen::VectorXd::Random(rows);
  const Eigen::VectorXd x = A.colPivHouseholderQr().solve(b);
  const Eigen::Matrix4d inverse = (A.transpose() * A).inverse();
  std::vector<std::string> texts;
  for (double value : x) texts.push_back(fmt::format("{:.3f}", value));
  std::sort(texts.begin(), texts.end());
  fmt::print("{} {:.3e} {}\n", fmt::join(texts, " "), inverse.norm(), given.size());
}
