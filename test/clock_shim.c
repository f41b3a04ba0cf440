/* Preloaded into a lab (LD_PRELOAD): its wall clock is off by the nanoseconds in the file CLOCK_SHIM.

   A test sets the clock of the lab's processes, all at the same instant, and no other's. Waits until
   a time of the wall clock end when that time is reached on the clock as it was at their begin. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <semaphore.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

static const volatile int64_t *offset_ns;
static int (*real_clock_gettime)(clockid_t, struct timespec *);

__attribute__((constructor)) static void open_offset(void) {
  const char *path = getenv("CLOCK_SHIM");
  int file = path ? open(path, O_RDONLY | O_CLOEXEC) : -1;
  if (file < 0) return;
  void *found = mmap(NULL, sizeof(int64_t), PROT_READ, MAP_SHARED, file, 0);
  if (found != MAP_FAILED) offset_ns = found;
  close(file);
}

int clock_gettime(clockid_t id, struct timespec *now) {
  if (!real_clock_gettime) real_clock_gettime = dlsym(RTLD_NEXT, "clock_gettime");
  int result = real_clock_gettime(id, now);
  if (result == 0 && id == CLOCK_REALTIME && offset_ns) {
    int64_t ns = now->tv_sec * INT64_C(1000000000) + now->tv_nsec + *offset_ns;
    now->tv_sec = ns / 1000000000;
    now->tv_nsec = ns % 1000000000;
  }
  return result;
}

int gettimeofday(struct timeval *restrict now, void *restrict zone) {
  struct timespec exact;
  (void)zone;
  int result = clock_gettime(CLOCK_REALTIME, &exact);
  now->tv_sec = exact.tv_sec;
  now->tv_usec = exact.tv_nsec / 1000;
  return result;
}

time_t time(time_t *into) {
  struct timespec exact;
  clock_gettime(CLOCK_REALTIME, &exact);
  if (into) *into = exact.tv_sec;
  return exact.tv_sec;
}

/* What waits by the monotonic clock gives seconds since the machine was started. */
static struct timespec real_deadline(const struct timespec *deadline) {
  struct timespec real = *deadline;
  if (offset_ns && real.tv_sec > 1000000000) {
    int64_t ns = real.tv_sec * INT64_C(1000000000) + real.tv_nsec - *offset_ns;
    real.tv_sec = ns / 1000000000;
    real.tv_nsec = ns % 1000000000;
  }
  return real;
}

static void *next(const char *name) {
  /* The versions of x86-64 and of aarch64; without one the oldest would be found. */
  void *found = dlvsym(RTLD_NEXT, name, "GLIBC_2.3.2");
  if (!found) found = dlvsym(RTLD_NEXT, name, "GLIBC_2.17");
  return found ? found : dlsym(RTLD_NEXT, name);
}

int pthread_cond_timedwait(pthread_cond_t *cond, pthread_mutex_t *mutex,
                           const struct timespec *deadline) {
  static int (*real)(pthread_cond_t *, pthread_mutex_t *, const struct timespec *);
  if (!real) real = next("pthread_cond_timedwait");
  struct timespec until = real_deadline(deadline);
  return real(cond, mutex, &until);
}

int pthread_mutex_timedlock(pthread_mutex_t *mutex, const struct timespec *deadline) {
  static int (*real)(pthread_mutex_t *, const struct timespec *);
  if (!real) real = next("pthread_mutex_timedlock");
  struct timespec until = real_deadline(deadline);
  return real(mutex, &until);
}

int sem_timedwait(sem_t *semaphore, const struct timespec *deadline) {
  static int (*real)(sem_t *, const struct timespec *);
  if (!real) real = next("sem_timedwait");
  struct timespec until = real_deadline(deadline);
  return real(semaphore, &until);
}
