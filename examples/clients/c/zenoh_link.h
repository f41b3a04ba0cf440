/* The part of zenoh's protocol (version 9, zenoh 1.x) that a client of the lab needs, over TCP.
 *
 * One thread, one link, no dependency. All memory that grows is bounded by what the lab sends. */
#ifndef ZENOH_LINK_H
#define ZENOH_LINK_H

#include <stddef.h>
#include <stdint.h>

typedef struct zlink zlink;

/* A message of a key, or an answer. The bytes belong to the link and are valid during the call. */
typedef struct {
    const char *key;
    const uint8_t *payload;
    size_t size;
    const char *attachment; /* ends with 0; empty: none */
    int is_error;           /* payload is a sentence */
} zsample;

typedef void (*zsample_callback)(const zsample *sample, void *context);

/* Connect to host and port; batch: the most bytes that the lab may send at once, 512 to 65535,
 * larger messages come in fragments. Returns NULL after printing the reason. */
zlink *zlink_open(const char *host, const char *port, uint16_t batch);
void zlink_close(zlink *link);

/* Receive the messages of a key from now on, in zlink_wait() and zlink_get(). 0: the link broke. */
int zlink_subscribe(zlink *link, const char *key, zsample_callback callback, void *context);

/* Query a selector, such as robots or assets/robots.json?offset=0;length=4096, until its answers
 * are complete. Returns how many there were; -1: the link broke, or time is over. */
int zlink_get(zlink *link, const char *selector, zsample_callback callback, void *context,
              int timeout_ms);

/* Receive for at most timeout_ms, and keep the link alive. 0: the link broke. */
int zlink_wait(zlink *link, int timeout_ms);

#endif
