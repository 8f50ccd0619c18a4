/* Preloaded, it makes one call of the C library fail: FAIL_CALL=kind:number:error, for example
 * write:3:ENOSPC as a number. Kinds: malloc, open, read, write, rename, fsync, thread,
 * process. With
 * FAIL_CALL_COUNTS=file the number of calls of each kind is written there when the program ends.
 * Calls before main() count as well. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

enum kind { MALLOC, OPEN, READ, WRITE, RENAME, FSYNC, THREAD, PROCESS, KINDS };
static const char* const names[KINDS] = {"malloc", "open",  "read",   "write",
                                         "rename", "fsync", "thread", "process"};
static atomic_long counts[KINDS];
static atomic_int state; /* 0: FAIL_CALL not yet read, 1: it is being read, 2: read */
static int failing_kind = -1, failing_error;
static long failing_number;

static void read_request(void) {
  int expected = 0;
  if (!atomic_compare_exchange_strong(&state, &expected, 1)) return;
  const char* text = getenv("FAIL_CALL");
  for (int kind = 0; text && kind < KINDS; ++kind) {
    const size_t length = strlen(names[kind]);
    if (strncmp(text, names[kind], length) || text[length] != ':') continue;
    char* rest;
    failing_number = strtol(text + length + 1, &rest, 10);
    failing_error = (int)strtol(rest + 1, NULL, 10);
    failing_kind = kind;
  }
  atomic_store(&state, 2);
}

/* Counts a call; true when it must fail. */
static int fails(enum kind kind) {
  if (atomic_load(&state) != 2) read_request();
  const long number = atomic_fetch_add(&counts[kind], 1) + 1;
  if ((int)kind != failing_kind || number != failing_number) return 0;
  errno = failing_error;
  return 1;
}

__attribute__((destructor)) static void write_counts(void) {
  const char* path = getenv("FAIL_CALL_COUNTS");
  if (!path) return;
  const int file = (int)syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  char line[64];
  for (int kind = 0; kind < KINDS; ++kind) {
    const int length =
        snprintf(line, sizeof line, "%s %ld\n", names[kind], atomic_load(&counts[kind]));
    if (syscall(SYS_write, file, line, length) != length) break;
  }
  syscall(SYS_close, file);
}

extern void *__libc_malloc(size_t), *__libc_calloc(size_t, size_t), *__libc_realloc(void*, size_t),
    *__libc_memalign(size_t, size_t);
void* malloc(size_t size) { return fails(MALLOC) ? NULL : __libc_malloc(size); }
void* calloc(size_t n, size_t size) { return fails(MALLOC) ? NULL : __libc_calloc(n, size); }
void* realloc(void* old, size_t size) { return fails(MALLOC) ? NULL : __libc_realloc(old, size); }
void* aligned_alloc(size_t alignment, size_t size) {
  return fails(MALLOC) ? NULL : __libc_memalign(alignment, size);
}
int posix_memalign(void** to, size_t alignment, size_t size) {
  if (fails(MALLOC)) return ENOMEM;
  *to = __libc_memalign(alignment, size);
  return *to ? 0 : ENOMEM;
}

static int open_at(int folder, const char* path, int flags, va_list more) {
  if (fails(OPEN)) return -1;
  const int has_mode = (flags & O_CREAT) || (flags & O_TMPFILE) == O_TMPFILE;
  return (int)syscall(SYS_openat, folder, path, flags, has_mode ? va_arg(more, mode_t) : 0);
}
#define OPEN_AT(folder)                                  \
  va_list more;                                          \
  va_start(more, flags);                                 \
  const int result = open_at(folder, path, flags, more); \
  va_end(more);                                          \
  return result
int open(const char* path, int flags, ...) { OPEN_AT(AT_FDCWD); }
int open64(const char* path, int flags, ...) { OPEN_AT(AT_FDCWD); }
int openat(int folder, const char* path, int flags, ...) { OPEN_AT(folder); }
int openat64(int folder, const char* path, int flags, ...) { OPEN_AT(folder); }
int __open_2(const char* path, int flags) { return open(path, flags); }
int __open64_2(const char* path, int flags) { return open(path, flags); }

ssize_t read(int file, void* to, size_t size) {
  return fails(READ) ? -1 : syscall(SYS_read, file, to, size);
}
ssize_t __read_chk(int file, void* to, size_t size, size_t room) {
  return size > room ? -1 : read(file, to, size);
}
ssize_t write(int file, const void* from, size_t size) {
  return fails(WRITE) ? -1 : syscall(SYS_write, file, from, size);
}
ssize_t pread64(int file, void* to, size_t size, off64_t at) {
  return fails(READ) ? -1 : syscall(SYS_pread64, file, to, size, at);
}
ssize_t pwrite64(int file, const void* from, size_t size, off64_t at) {
  return fails(WRITE) ? -1 : syscall(SYS_pwrite64, file, from, size, at);
}
int ftruncate64(int file, off64_t size) {
  return fails(WRITE) ? -1 : (int)syscall(SYS_ftruncate, file, size);
}
int rename(const char* from, const char* to) {
  return fails(RENAME) ? -1 : (int)syscall(SYS_rename, from, to);
}
int renameat2(int a, const char* from, int b, const char* to, unsigned flags) {
  return fails(RENAME) ? -1 : (int)syscall(SYS_renameat2, a, from, b, to, flags);
}
int linkat(int a, const char* from, int b, const char* to, int flags) {
  return fails(RENAME) ? -1 : (int)syscall(SYS_linkat, a, from, b, to, flags);
}
int mkdir(const char* path, mode_t mode) {
  return fails(RENAME) ? -1 : (int)syscall(SYS_mkdir, path, mode);
}
int fsync(int file) { return fails(FSYNC) ? -1 : (int)syscall(SYS_fsync, file); }
int fdatasync(int file) { return fails(FSYNC) ? -1 : (int)syscall(SYS_fdatasync, file); }
int syncfs(int file) { return fails(FSYNC) ? -1 : (int)syscall(SYS_syncfs, file); }

int pthread_create(pthread_t* thread, const pthread_attr_t* how, void* (*run)(void*), void* with) {
  if (fails(THREAD)) return EAGAIN;
  int (*create)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  *(void**)&create = dlsym(RTLD_NEXT, "pthread_create");
  return create(thread, how, run, with);
}

pid_t _Fork(void) {
  if (fails(PROCESS)) return -1;
  pid_t (*fork_now)(void);
  *(void**)&fork_now = dlsym(RTLD_NEXT, "_Fork");
  return fork_now();
}
int pipe2(int ends[2], int flags) {
  return fails(PROCESS) ? -1 : (int)syscall(SYS_pipe2, ends, flags);
}
