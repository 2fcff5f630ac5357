// A browser has no other processes, and the C library for it leaves these out.

#include <errno.h>
#include <sys/resource.h>
#include <sys/types.h>

pid_t wait4(pid_t process, int* status, int options, struct rusage* usage) {
  (void)process, (void)status, (void)options, (void)usage;
  errno = ENOSYS;
  return -1;
}

int prctl(int operation, ...) {
  (void)operation;
  errno = ENOSYS;
  return -1;
}
