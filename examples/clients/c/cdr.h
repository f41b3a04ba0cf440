/* Reads CDR as ROS 2 writes it: little-endian, each number aligned to its size, counted from
 * behind the header of 4 bytes. After the end all that is read is 0 and `bad` is set. */
#ifndef CDR_H
#define CDR_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

typedef struct {
    const uint8_t *start, *at, *end;
    int bad;
} cdr;

static inline cdr cdr_begin(const uint8_t *payload, size_t size) {
    size_t head = size < 4 ? size : 4;
    return (cdr){payload + head, payload + head, payload + size, size < 4 || payload[1] != 1};
}

static inline const uint8_t *cdr_take(cdr *in, size_t align, size_t size) {
    static const uint8_t nothing[8];
    size_t skip = (align - (size_t)(in->at - in->start) % align) % align;
    if (in->bad || skip + size > (size_t)(in->end - in->at)) {
        in->bad = 1;
        return nothing;
    }
    in->at += skip + size;
    return in->at - size;
}

static inline uint32_t cdr_uint32(cdr *in) {
    uint32_t value;
    memcpy(&value, cdr_take(in, 4, 4), 4);
    return in->bad ? 0 : value;
}

static inline double cdr_double(cdr *in) {
    double value;
    memcpy(&value, cdr_take(in, 8, 8), 8);
    return in->bad ? 0 : value;
}

/* Read a text, cut to `size` with its 0. */
static inline void cdr_text(cdr *in, char *out, size_t size) {
    uint32_t length = cdr_uint32(in); /* with its 0 */
    const uint8_t *text = cdr_take(in, 1, length);
    size_t kept = in->bad || !length ? 0 : length - 1 < size - 1 ? length - 1 : size - 1;
    memcpy(out, text, kept);
    out[kept] = 0;
}

/* Skip a std_msgs/Header. */
static inline void cdr_header(cdr *in) {
    char frame[2];
    cdr_uint32(in), cdr_uint32(in), cdr_text(in, frame, sizeof frame);
}

#endif
