#include "zenoh_link.h"

#include <netdb.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

enum { VERSION = 9, CLIENT = 2, LEASE_MS = 10000, KEEP_ALIVE_MS = 2500 };
enum { INIT = 0x01, OPEN = 0x02, CLOSE = 0x03, KEEP_ALIVE = 0x04, FRAME = 0x05, FRAGMENT = 0x06 };
enum { INTEREST = 0x19, FINAL = 0x1a, RESPONSE = 0x1b, REQUEST = 0x1c, PUSH = 0x1d, DECLARE = 0x1e };
enum { PUT = 0x01, DEL = 0x02, QUERY = 0x03, REPLY = 0x04, ERROR = 0x05 };
enum { D_KEY = 0x00, U_KEY = 0x01, D_SUBSCRIBER = 0x02, D_QUERYABLE = 0x04, D_TOKEN = 0x06,
       D_FINAL = 0x1a };
/* The lowest five bits are the message; the others are flags. */
enum { ID = 0x1f, F1 = 0x20, F2 = 0x40, EXTENDED = 0x80 };
enum { QOS = 0x21, BACKGROUND = 7, BLOCK = 0x08 };
enum { KEYS = 1024, KEY_SIZE = 512, LARGEST = 64 * 1024 * 1024 };

typedef struct {
    const uint8_t *at, *end;
    int bad;
} reader;

typedef struct {
    uint8_t *data;
    size_t size;
} buffer;

struct zlink {
    int socket;
    uint64_t sequence, requests;
    long long sent_ms;
    uint8_t batch[65536];
    buffer parts[2]; /* fragments: best effort, reliable */
    char *keys[KEYS];  /* what the other side abbreviates */
    struct {
        char *key;
        zsample_callback callback;
        void *context;
    } subscribers[16];
    int subscriber_count;
    uint64_t asked; /* the query that waits, and its answers */
    zsample_callback on_answer;
    void *answer_context;
    int answers, complete;
};

static long long now_ms(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (long long)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

/* Reading. After the end all that is read is 0 and `bad` is set. */

static uint8_t read_byte(reader *in) {
    if (in->at >= in->end) {
        in->bad = 1;
        return 0;
    }
    return *in->at++;
}

/* A number: seven bits a byte, the lowest first; the ninth byte has eight. */
static uint64_t read_number(reader *in) {
    uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
        uint8_t byte = read_byte(in);
        if (shift == 56) return value | (uint64_t)byte << 56;
        value |= (uint64_t)(byte & 0x7f) << shift;
        if (!(byte & 0x80)) break;
    }
    return value;
}

static const uint8_t *read_bytes(reader *in, uint64_t size) {
    const uint8_t *found = in->at;
    if (size > (uint64_t)(in->end - in->at)) {
        in->bad = 1;
        in->at = in->end;
        return found;
    }
    in->at += size;
    return found;
}

static void read_slice(reader *in, const uint8_t **data, size_t *size) {
    uint64_t length = read_number(in);
    *data = read_bytes(in, length);
    *size = in->bad ? 0 : (size_t)length;
}

/* Extensions follow where a header has its highest bit; that of the attachment is 3. */
static void read_extensions(reader *in, int present, char **attachment) {
    while (present && !in->bad) {
        uint8_t header = read_byte(in);
        const uint8_t *data = NULL;
        size_t size = 0;
        int encoding = header >> 5 & 3;
        if (encoding == 1) read_number(in);
        if (encoding == 2) read_slice(in, &data, &size);
        if (attachment && encoding == 2 && (header & 0x0f) == 3 && !*attachment) {
            *attachment = malloc(size + 1);
            if (*attachment) memcpy(*attachment, data, size), (*attachment)[size] = 0;
        }
        present = header & EXTENDED;
    }
}

/* A key: a number that abbreviates its beginning, or 0, and the rest. */
static void read_key(zlink *link, reader *in, int has_rest, char key[KEY_SIZE]) {
    uint64_t number = read_number(in);
    const uint8_t *rest = NULL;
    size_t size = 0;
    if (has_rest) read_slice(in, &rest, &size);
    const char *known = number && number < KEYS && link->keys[number] ? link->keys[number] : "";
    snprintf(key, KEY_SIZE, "%s%.*s", known, (int)size, size ? (const char *)rest : "");
}

/* Sending: a batch is a size of two bytes and one message of the transport. */

static int send_batch(zlink *link, const uint8_t *data, size_t size) {
    uint8_t head[2] = {size & 0xff, size >> 8 & 0xff};
    struct { const uint8_t *data; size_t size; } parts[2] = {{head, 2}, {data, size}};
    for (int i = 0; i < 2; i++) {
        while (parts[i].size) {
            ssize_t sent = send(link->socket, parts[i].data, parts[i].size, MSG_NOSIGNAL);
            if (sent <= 0) return 0;
            parts[i].data += sent;
            parts[i].size -= (size_t)sent;
        }
    }
    link->sent_ms = now_ms();
    return 1;
}

static uint8_t *put_number(uint8_t *out, uint64_t value) {
    for (; value > 0x7f; value >>= 7) *out++ = (uint8_t)(value | 0x80);
    *out++ = (uint8_t)value;
    return out;
}

static uint8_t *put_text(uint8_t *out, const char *text, size_t size) {
    out = put_number(out, size);
    memcpy(out, text, size);
    return out + size;
}

static uint8_t *begin_frame(zlink *link, uint8_t *out) {
    *out++ = FRAME | F1; /* reliable */
    uint64_t number = link->sequence;
    link->sequence = (number + 1) & 0x0fffffff; /* sequence numbers have 28 bits */
    return put_number(out, number);
}

/* Receiving. */

static int read_exactly(zlink *link, uint8_t *data, size_t size) {
    while (size) {
        ssize_t got = recv(link->socket, data, size, 0);
        if (got <= 0) return 0;
        data += got;
        size -= (size_t)got;
    }
    return 1;
}

/* Read one batch into link->batch; return its size, 0: the link broke. */
static size_t read_batch(zlink *link) {
    uint8_t head[2];
    if (read_exactly(link, head, 2)) {
        size_t size = head[0] | (size_t)head[1] << 8;
        if (size && read_exactly(link, link->batch, size)) return size;
    }
    fprintf(stderr, "the link to the lab broke\n");
    return 0;
}

static void on_put(zlink *link, reader *in, const char *key, int is_answer) {
    uint8_t header = read_byte(in);
    char *attachment = NULL;
    zsample sample = {.key = key, .attachment = ""};
    if ((header & ID) == PUT) {
        const uint8_t *skipped;
        size_t size;
        if (header & F1) read_number(in), read_slice(in, &skipped, &size); /* time stamp */
        if (header & F2 && read_number(in) & 1) read_slice(in, &skipped, &size); /* encoding */
        read_extensions(in, header & EXTENDED, &attachment);
        read_slice(in, &sample.payload, &sample.size);
        if (attachment) sample.attachment = attachment;
        if (!in->bad && is_answer) {
            link->answers++;
            if (link->on_answer) link->on_answer(&sample, link->answer_context);
        }
        for (int i = 0; !in->bad && !is_answer && i < link->subscriber_count; i++)
            if (!strcmp(key, link->subscribers[i].key))
                link->subscribers[i].callback(&sample, link->subscribers[i].context);
    } else if ((header & ID) == DEL) {
        const uint8_t *skipped;
        size_t size;
        if (header & F1) read_number(in), read_slice(in, &skipped, &size);
        read_extensions(in, header & EXTENDED, NULL);
    } else {
        in->bad = 1;
    }
    free(attachment);
}

static void on_response(zlink *link, reader *in, uint8_t header) {
    char key[KEY_SIZE];
    uint64_t request = read_number(in);
    read_key(link, in, header & F1, key);
    read_extensions(in, header & EXTENDED, NULL);
    int waited_for = request == link->asked && !link->complete;
    uint8_t body = read_byte(in);
    if ((body & ID) == REPLY) {
        if (body & F1) read_byte(in); /* consolidation */
        read_extensions(in, body & EXTENDED, NULL);
        zsample_callback wanted = link->on_answer;
        if (!waited_for) link->on_answer = NULL;
        on_put(link, in, key, 1);
        link->on_answer = wanted;
    } else if ((body & ID) == ERROR) {
        const uint8_t *skipped;
        size_t size;
        zsample sample = {.key = key, .attachment = "", .is_error = 1};
        if (body & F2 && read_number(in) & 1) read_slice(in, &skipped, &size);
        read_extensions(in, body & EXTENDED, NULL);
        read_slice(in, &sample.payload, &sample.size);
        if (!in->bad && waited_for) {
            link->answers++;
            if (link->on_answer) link->on_answer(&sample, link->answer_context);
        }
    } else {
        in->bad = 1;
    }
}

static void on_declare(zlink *link, reader *in, uint8_t header) {
    char key[KEY_SIZE];
    if (header & F1) read_number(in); /* the interest that it answers */
    read_extensions(in, header & EXTENDED, NULL);
    uint8_t body = read_byte(in);
    uint8_t kind = body & ID;
    uint64_t number = kind == D_FINAL ? 0 : read_number(in);
    if (kind == D_KEY || kind == D_SUBSCRIBER || kind == D_QUERYABLE || kind == D_TOKEN)
        read_key(link, in, body & F1, key);
    read_extensions(in, body & EXTENDED, NULL);
    if (in->bad || !number || number >= KEYS) return;
    if (kind == D_KEY || kind == U_KEY) free(link->keys[number]), link->keys[number] = NULL;
    if (kind == D_KEY) link->keys[number] = strdup(key);
}

/* The other side asks what this client declares; it declares no more than it has. */
static int on_interest(zlink *link, reader *in, uint8_t header) {
    char key[KEY_SIZE];
    uint64_t number = read_number(in);
    int now = header & F1, later = header & F2;
    if (now || later) {
        uint8_t options = read_byte(in);
        if (options & 0x10) read_key(link, in, options & 0x20, key);
    }
    read_extensions(in, header & EXTENDED, NULL);
    if (in->bad || !now) return 1;
    uint8_t out[32], *end = begin_frame(link, out);
    *end++ = DECLARE | F1;
    end = put_number(end, number);
    *end++ = D_FINAL;
    return send_batch(link, out, (size_t)(end - out));
}

/* Read the messages of a frame or of a message that came in fragments. */
static int on_messages(zlink *link, reader *in) {
    char key[KEY_SIZE];
    while (in->at < in->end && !in->bad) {
        uint8_t header = read_byte(in);
        switch (header & ID) {
        case PUSH:
            read_key(link, in, header & F1, key);
            read_extensions(in, header & EXTENDED, NULL);
            on_put(link, in, key, 0);
            break;
        case RESPONSE:
            on_response(link, in, header);
            break;
        case FINAL:
            if (read_number(in) == link->asked) link->complete = 1;
            read_extensions(in, header & EXTENDED, NULL);
            break;
        case DECLARE:
            on_declare(link, in, header);
            break;
        case INTEREST:
            if (!on_interest(link, in, header)) return 0;
            break;
        default:
            in->at--; /* the next message of the transport */
            return 1;
        }
    }
    return 1;
}

static int on_fragment(zlink *link, reader *in, uint8_t header) {
    buffer *part = &link->parts[header & F1 ? 1 : 0];
    read_number(in);
    read_extensions(in, header & EXTENDED, NULL);
    size_t more = (size_t)(in->end - in->at);
    uint8_t *grown = part->size + more > LARGEST ? NULL : realloc(part->data, part->size + more + 1);
    if (!grown) {
        fprintf(stderr, "a message is too large for this client\n");
        return 0;
    }
    part->data = grown;
    memcpy(part->data + part->size, in->at, more);
    part->size += more;
    if (header & F2) return 1; /* more follows */
    reader whole = {part->data, part->data + part->size, 0};
    int alive = on_messages(link, &whole);
    free(part->data);
    *part = (buffer){0};
    return alive;
}

/* Read one batch and all that is in it. */
static int receive(zlink *link) {
    size_t size = read_batch(link);
    reader in = {link->batch, link->batch + size, !size};
    while (!in.bad && in.at < in.end) {
        uint8_t header = read_byte(&in);
        switch (header & ID) {
        case KEEP_ALIVE:
            read_extensions(&in, header & EXTENDED, NULL);
            break;
        case FRAME:
            read_number(&in);
            read_extensions(&in, header & EXTENDED, NULL);
            if (!on_messages(link, &in)) return 0;
            break;
        case FRAGMENT:
            return on_fragment(link, &in, header);
        case CLOSE:
            fprintf(stderr, "the lab closed the link, reason %d\n", read_byte(&in));
            return 0;
        default:
            fprintf(stderr, "this client does not know the message %02x\n", header);
            return 0;
        }
    }
    if (in.bad && size) fprintf(stderr, "this client cannot read what the lab sent\n");
    return !in.bad;
}

int zlink_wait(zlink *link, int timeout_ms) {
    long long end = now_ms() + timeout_ms;
    for (;;) {
        long long now = now_ms(), due = link->sent_ms + KEEP_ALIVE_MS;
        if (now >= due) {
            uint8_t alive = KEEP_ALIVE;
            if (!send_batch(link, &alive, 1)) return 0;
            continue;
        }
        struct pollfd ready = {.fd = link->socket, .events = POLLIN};
        int found = poll(&ready, 1, (int)((end < due ? end : due) - now < 0 ? 0 : (end < due ? end : due) - now));
        if (found > 0) return receive(link);
        if (now_ms() >= end) return 1;
    }
}

static int handshake(zlink *link, uint16_t batch) {
    uint8_t out[512], *end = out;
    *end++ = INIT | F2; /* with sizes */
    *end++ = VERSION;
    *end++ = CLIENT | 15 << 4; /* an id of 16 bytes follows */
    FILE *random = fopen("/dev/urandom", "rb");
    size_t got = random ? fread(end, 1, 16, random) : 0;
    if (random) fclose(random);
    if (got != 16) return 0;
    end[15] |= 1; /* the last byte of an id is not 0 */
    end += 16;
    *end++ = 0x0a; /* sequence numbers and requests of 32 bits */
    *end++ = batch & 0xff;
    *end++ = batch >> 8 & 0xff;
    if (!send_batch(link, out, (size_t)(end - out))) return 0;

    size_t size = read_batch(link);
    reader in = {link->batch, link->batch + size, !size};
    const uint8_t *cookie;
    size_t cookie_size;
    uint8_t header = read_byte(&in);
    if ((header & ID) != INIT || !(header & F1) || read_byte(&in) != VERSION) return 0;
    read_bytes(&in, (read_byte(&in) >> 4) + 1u);
    if (header & F2) read_bytes(&in, 3);
    read_slice(&in, &cookie, &cookie_size);
    if (in.bad || cookie_size > 400) return 0;
    end = out;
    *end++ = OPEN;
    end = put_number(end, LEASE_MS);
    end = put_number(end, link->sequence);
    end = put_text(end, (const char *)cookie, cookie_size);
    if (!send_batch(link, out, (size_t)(end - out))) return 0;
    size = read_batch(link);
    return size && (link->batch[0] & (ID | F1)) == (OPEN | F1);
}

zlink *zlink_open(const char *host, const char *port, uint16_t batch) {
    struct addrinfo *found = NULL, hints = {.ai_socktype = SOCK_STREAM};
    zlink *link = calloc(1, sizeof *link);
    if (!link) return NULL;
    link->socket = -1;
    if (!getaddrinfo(host, port, &hints, &found))
        for (struct addrinfo *each = found; each && link->socket < 0; each = each->ai_next) {
            link->socket = socket(each->ai_family, each->ai_socktype, each->ai_protocol);
            if (link->socket >= 0 && connect(link->socket, each->ai_addr, each->ai_addrlen)) {
                close(link->socket);
                link->socket = -1;
            }
        }
    if (found) freeaddrinfo(found);
    if (link->socket < 0) {
        fprintf(stderr, "no lab at %s port %s: start one with `mrlab up`\n", host, port);
    } else if (!handshake(link, batch)) {
        fprintf(stderr, "%s port %s does not speak zenoh 1.x, or wants TLS\n", host, port);
    } else {
        return link;
    }
    zlink_close(link);
    return NULL;
}

void zlink_close(zlink *link) {
    if (!link) return;
    if (link->socket >= 0) {
        uint8_t bye[2] = {CLOSE | F1, 0};
        send_batch(link, bye, sizeof bye);
        close(link->socket);
    }
    for (int i = 0; i < KEYS; i++) free(link->keys[i]);
    for (int i = 0; i < link->subscriber_count; i++) free(link->subscribers[i].key);
    for (int i = 0; i < 2; i++) free(link->parts[i].data);
    free(link);
}

int zlink_subscribe(zlink *link, const char *key, zsample_callback callback, void *context) {
    uint8_t out[KEY_SIZE + 64], *end;
    int number = link->subscriber_count;
    if (strlen(key) >= KEY_SIZE || number == 16) return 0;
    link->subscribers[number].key = strdup(key);
    link->subscribers[number].callback = callback;
    link->subscribers[number].context = context;
    link->subscriber_count++;
    end = begin_frame(link, out);
    *end++ = DECLARE;
    *end++ = D_SUBSCRIBER | F1;
    end = put_number(end, (uint64_t)number + 1);
    end = put_number(end, 0);
    end = put_text(end, key, strlen(key));
    return send_batch(link, out, (size_t)(end - out));
}

int zlink_get(zlink *link, const char *selector, zsample_callback callback, void *context,
              int timeout_ms) {
    uint8_t out[KEY_SIZE + 256], *end;
    const char *mark = strchr(selector, '?');
    size_t key_size = mark ? (size_t)(mark - selector) : strlen(selector);
    if (strlen(selector) >= KEY_SIZE) return -1;
    link->asked = ++link->requests;
    link->on_answer = callback;
    link->answer_context = context;
    link->answers = link->complete = 0;
    end = begin_frame(link, out);
    *end++ = REQUEST | F1 | EXTENDED;
    end = put_number(end, link->asked);
    end = put_number(end, 0);
    end = put_text(end, selector, key_size);
    *end++ = QOS;
    *end++ = BACKGROUND | BLOCK; /* the answers have it too: they wait for a full link */
    *end++ = mark ? QUERY | F2 : QUERY;
    if (mark) end = put_text(end, mark + 1, strlen(mark + 1));
    if (!send_batch(link, out, (size_t)(end - out))) return -1;
    long long until = now_ms() + timeout_ms;
    while (!link->complete) {
        long long left = until - now_ms();
        if (left <= 0 || !zlink_wait(link, (int)left)) return -1;
    }
    return link->answers;
}
