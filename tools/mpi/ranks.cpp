#include <tools/mpi/ranks.hpp>

#include <new>

namespace simdbezier::tools {

Ranks::Ranks(MPI_Comm communicator) : communicator_(communicator) {
  MPI_Comm_rank(communicator_, &rank_);
  MPI_Comm_size(communicator_, &count_);
}

void Ranks::together(const std::function<void()>& work) const {
  int code = 0;
  std::string message;
  try {
    work();
  } catch (const Failure& failure) {
    code = failure.exit_code();
    message = failure.what();
  } catch (const std::bad_alloc&) {
    code = 1;
    message = "not enough memory";
  } catch (const std::exception& error) {
    code = 1;
    message = error.what();
  }
  const int mine = code == 0 ? count_ : rank_;
  int failed = count_;
  MPI_Allreduce(&mine, &failed, 1, MPI_INT, MPI_MIN, communicator_);
  if (failed == count_) {
    return;
  }
  int about[2] = {code, static_cast<int>(message.size())};
  MPI_Bcast(about, 2, MPI_INT, failed, communicator_);
  message.resize(static_cast<std::size_t>(about[1]));
  MPI_Bcast(message.data(), about[1], MPI_CHAR, failed, communicator_);
  throw Failure(about[0], message);
}

std::uint64_t Ranks::sum(std::uint64_t value) const {
  std::uint64_t all = 0;
  MPI_Allreduce(&value, &all, 1, MPI_UINT64_T, MPI_SUM, communicator_);
  return all;
}

double Ranks::most(double value) const {
  double all = 0;
  MPI_Allreduce(&value, &all, 1, MPI_DOUBLE, MPI_MAX, communicator_);
  return all;
}

std::uint64_t Ranks::sum_before(std::uint64_t value) const {
  std::uint64_t before = 0;
  MPI_Exscan(&value, &before, 1, MPI_UINT64_T, MPI_SUM, communicator_);
  return is_first() ? 0 : before; // which MPI_Exscan leaves undefined
}

std::vector<std::uint64_t> Ranks::of_first(std::vector<std::uint64_t> values) const {
  values.resize(sum(is_first() ? values.size() : 0));
  MPI_Bcast(values.data(), static_cast<int>(values.size()), MPI_UINT64_T, 0, communicator_);
  return values;
}

std::vector<double> Ranks::gather(const std::vector<double>& values) const {
  std::vector<double> all(is_first() ? values.size() * static_cast<std::size_t>(count_) : 0);
  const auto each = static_cast<int>(values.size());
  MPI_Gather(values.data(), each, MPI_DOUBLE, all.data(), each, MPI_DOUBLE, 0, communicator_);
  return all;
}

} // namespace simdbezier::tools
