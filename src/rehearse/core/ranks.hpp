#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace rehearse {

/// Processes that were started together and run the same program: the ranks of MPI. An implementation transports bytes;
/// this class defines their meaning.
///
/// The public calls down to `leave` are made by all ranks in the same order, each on one thread at a time. Where a rank
/// breaks this (it met an exception that the others did not), all the others throw instead of waiting for ever.
class Ranks {
 public:
  Ranks() = default;
  virtual ~Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  virtual int rank() const = 0;  // 0 leads
  virtual int size() const = 0;

  /// Returns what every rank gave, in order of rank. step: what all are at, "open the folder"; all throw where ranks
  /// differ.
  std::vector<std::string> exchange(std::string_view step, std::string_view bytes);

  /// Rank 0 calls `work`, and every rank returns what it returned. Its exception is thrown everywhere.
  std::string once(std::string_view step, const std::function<std::string()>& work);

  struct End {
    int rank = 0;
    int code = 0;         // 0: all is well
    std::string message;  // what went wrong
  };
  /// The last call: how each rank ended, by rank; only this one's end if another left earlier.
  std::vector<End> leave(int code, const std::string& message);

  /// Asks rank 0 and waits for the answer. On any thread of any other rank while rank 0 answers, and on no thread while
  /// the calls above are being made.
  virtual std::string ask(const std::string& question) = 0;

  /// On rank 0: answers the next question, if one has come.
  virtual bool answer(const std::function<std::string(const std::string& question)>& reply) = 0;

 protected:
  /// Returns what every rank gave, in order of rank, once all of it is there.
  virtual std::vector<std::string> carry(const std::string& bytes) = 0;

 private:
  void check_steps(std::string_view step, const std::vector<std::string>& steps, const std::vector<std::string>& given);

  bool over_ = false;  // a rank has left
};

}  // namespace rehearse
