// SPDX-License-Identifier: GPL-3.0-or-later
// Preloaded before the C library: while the file named by TOILE_TEST_DISK_FULL exists, nothing can be written to regular
// files, as on a full disk.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

static int is_full(int descriptor) {
  const char* flag = getenv("TOILE_TEST_DISK_FULL");
  struct stat about;
  if (!flag || access(flag, F_OK) != 0) return 0;
  return fstat(descriptor, &about) == 0 && S_ISREG(about.st_mode);
}

#define REFUSE(descriptor) \
  if (is_full(descriptor)) return errno = ENOSPC, -1

ssize_t write(int descriptor, const void* bytes, size_t count) {
  static ssize_t (*next)(int, const void*, size_t);
  if (!next) next = (ssize_t(*)(int, const void*, size_t))dlsym(RTLD_NEXT, "write");
  REFUSE(descriptor);
  return next(descriptor, bytes, count);
}

ssize_t writev(int descriptor, const struct iovec* pieces, int count) {
  static ssize_t (*next)(int, const struct iovec*, int);
  if (!next) next = (ssize_t(*)(int, const struct iovec*, int))dlsym(RTLD_NEXT, "writev");
  REFUSE(descriptor);
  return next(descriptor, pieces, count);
}

ssize_t pwrite64(int descriptor, const void* bytes, size_t count, off64_t offset) {
  static ssize_t (*next)(int, const void*, size_t, off64_t);
  if (!next) next = (ssize_t(*)(int, const void*, size_t, off64_t))dlsym(RTLD_NEXT, "pwrite64");
  REFUSE(descriptor);
  return next(descriptor, bytes, count, offset);
}

ssize_t pwrite(int descriptor, const void* bytes, size_t count, off_t offset) {
  return pwrite64(descriptor, bytes, count, offset);
}
