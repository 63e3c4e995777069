// One run at a time in a folder of results.
#pragma once

#include <string>

namespace moire {

// Holds the folder while it lives. The lock is the system's (flock) on the folder itself: it leaves no file behind and
// ends with the process, however that ends. File systems without such locks are taken as free.
class FolderLock {
 public:
  // Throws Error (Exit::io) when another process holds the folder.
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int folder_ = -1;
};

}  // namespace moire
