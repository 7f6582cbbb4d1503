// A job whose pieces several processes may make, each a share of them, in one folder.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/text/data.h"
#include "jobs/common/session.h"
#include "stores/gather.h"
#include "stores/shard.h"

namespace ombre::jobs {

// Estimated costs of the pieces of a job.
struct PieceCosts {
  std::vector<double> seconds;  // of each piece on one thread, from the first one on
  double memory_bytes = 0;      // of a process
};

// A job that is planned. All processes plan it alike, each for itself. Methods throw as the kind's jobs do, and return
// exit codes.
class SharedJob {
 public:
  virtual ~SharedJob() = default;

  // Returns the folder in which the pieces lie until the job is complete.
  virtual std::string folder() const = 0;
  virtual const stores::StoredJob& stored() const = 0;
  virtual stores::PieceRange pieces() const = 0;
  // Returns everything that decides the pieces.
  virtual DataMembers description() const = 0;
  // Returns the first difference of an earlier description, such as "seed is 1 there and 2 here"; empty if there is
  // none.
  virtual std::string difference(const DataMembers& earlier) const = 0;
  virtual PieceCosts costs(Session& session) const = 0;
  // True if all shares need values of the whole job, such as supports, which prepare() makes and keeps in the folder. A
  // share makes them for itself where they are not kept.
  virtual bool has_stages() const { return false; }
  virtual int prepare(Session&) const { return done; }
  // Makes those of the pieces that the share has not made yet.
  virtual int make(stores::PieceRange range, const stores::Shard& shard, Session& session) const = 0;
  // Joins the shares' pieces, and makes what is missing.
  virtual int join(Session& session) const = 0;
};
using SharedJobPtr = std::unique_ptr<SharedJob>;

}  // namespace ombre::jobs
