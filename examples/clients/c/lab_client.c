/* Lists the robots of a lab, fetches one with its meshes, and follows its tool.
 *
 *     lab_client                      lists the robots in the scene
 *     lab_client ur5e_1 10            fetches its URDF and meshes, prints where tool0 is, 10 times
 *     lab_client --host 192.0.2.7 --port 7447 --batch 2048 --piece 1024 ur5e_1
 */
#include "cdr.h"
#include "urdf.h"
#include "zenoh_link.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME = 64, SELECTOR = 480, TIMEOUT_MS = 10000, ROBOTS = 64 };

typedef struct {
    char name[NAME], model[NAME], end_effector[NAME];
} robot;

typedef struct {
    robot robots[ROBOTS];
    int count;
} scene;

/* A file that comes in pieces. */
typedef struct {
    char *data; /* ends with 0 */
    size_t size, whole;
    char sha256[65];
    int failed;
} asset;

typedef struct {
    urdf_chain chain;
    int frames;
} watch;

/* mrlab_msgs/msg/Robots: a header, then of each robot three texts, a pose, names of joints. */
static void on_robots(const zsample *sample, void *context) {
    scene *found = context;
    cdr in = cdr_begin(sample->payload, sample->size);
    if (sample->is_error) return;
    cdr_header(&in);
    uint32_t count = cdr_uint32(&in);
    found->count = 0;
    for (uint32_t i = 0; i < count && i < ROBOTS && !in.bad; i++) {
        robot *each = &found->robots[found->count++];
        char joint[2];
        cdr_text(&in, each->name, NAME);
        cdr_text(&in, each->model, NAME);
        cdr_text(&in, each->end_effector, NAME);
        for (int k = 0; k < 7; k++) cdr_double(&in);
        for (uint32_t joints = cdr_uint32(&in); joints && !in.bad; joints--)
            cdr_text(&in, joint, sizeof joint);
    }
}

/* Copy a field of the flat JSON in an attachment. */
static void field(const char *json, const char *name, char *out, size_t size) {
    char wanted[32];
    snprintf(wanted, sizeof wanted, "\"%s\": ", name);
    const char *at = strstr(json, wanted);
    at = at ? at + strlen(wanted) : "";
    at += *at == '"';
    snprintf(out, size, "%.*s", (int)strcspn(at, "\",}"), at);
}

static void on_piece(const zsample *sample, void *context) {
    asset *file = context;
    char size[24], sha256[65];
    if (sample->is_error) {
        fprintf(stderr, "%.*s\n", (int)sample->size, (const char *)sample->payload);
        file->failed = 1;
        return;
    }
    field(sample->attachment, "size", size, sizeof size);
    field(sample->attachment, "sha256", sha256, sizeof sha256);
    char *grown = realloc(file->data, file->size + sample->size + 1);
    if (!grown || (file->size && strcmp(sha256, file->sha256))) {
        fprintf(stderr, "the file changed meanwhile, or there is no memory for it\n");
        file->failed = 1;
        return;
    }
    memcpy(grown + file->size, sample->payload, sample->size);
    file->data = grown;
    file->size += sample->size;
    file->data[file->size] = 0;
    file->whole = strtoul(size, NULL, 10);
    strcpy(file->sha256, sha256);
}

/* Fetch an asset, `piece` bytes at a time; data is NULL where there is none. */
static asset fetch(zlink *link, const char *key, unsigned piece) {
    asset file = {0};
    char selector[SELECTOR];
    do {
        size_t before = file.size;
        snprintf(selector, sizeof selector, "%s?offset=%zu;length=%u", key, file.size, piece);
        int answers = zlink_get(link, selector, on_piece, &file, TIMEOUT_MS);
        if (answers < 1 || (file.size == before && file.size < file.whole)) file.failed = 1;
    } while (!file.failed && file.size < file.whole);
    if (file.failed) free(file.data), file.data = NULL;
    return file;
}

/* Fetch every mesh that is drawn; package://x/y is the key assets/x/y. Returns 0 on failure. */
static int fetch_meshes(zlink *link, const char *urdf, unsigned piece) {
    size_t bytes = 0;
    int count = 0;
    for (const char *at = urdf; (at = strstr(at, "<visual")); ) {
        const char *end = strstr(at, "</visual>"), *uri = strstr(at, "package://");
        if (!end) break;
        if (uri && uri < end) {
            char key[SELECTOR];
            uri += strlen("package://");
            snprintf(key, sizeof key, "assets/%.*s", (int)strcspn(uri, "\""), uri);
            asset mesh = fetch(link, key, piece);
            if (!mesh.data) return 0;
            if (mesh.size < 12 || memcmp(mesh.data, "glTF", 4)) {
                fprintf(stderr, "%s is no binary glTF\n", key);
                return 0;
            }
            bytes += mesh.size;
            count++;
            free(mesh.data);
        }
        at = end;
    }
    printf("meshes %d, %zu bytes\n", count, bytes);
    return 1;
}

/* sensor_msgs/msg/JointState: a header, names, then as many positions. */
static void on_joint_state(const zsample *sample, void *context) {
    watch *robot = context;
    char names[URDF_JOINTS][NAME];
    double pose[3][4];
    cdr in = cdr_begin(sample->payload, sample->size);
    cdr_header(&in);
    uint32_t count = cdr_uint32(&in);
    if (count > URDF_JOINTS) return;
    for (uint32_t i = 0; i < count; i++) cdr_text(&in, names[i], NAME);
    if (cdr_uint32(&in) != count) return;
    for (uint32_t i = 0; i < count; i++) urdf_move(&robot->chain, names[i], cdr_double(&in));
    if (in.bad) return;
    urdf_forward(&robot->chain, pose);
    printf("tool0 %.6f %.6f %.6f\n", pose[0][3], pose[1][3], pose[2][3]);
    fflush(stdout);
    robot->frames++;
}

static int follow(zlink *link, const robot *wanted, int frames, unsigned piece) {
    char key[SELECTOR];
    watch watched = {0};
    snprintf(key, sizeof key, "assets/robots/%s%s%s.urdf", wanted->model,
             *wanted->end_effector ? "+" : "", wanted->end_effector);
    asset urdf = fetch(link, key, piece);
    if (!urdf.data) return 0;
    printf("urdf %s, %zu bytes\n", key, urdf.size);
    int good = fetch_meshes(link, urdf.data, piece);
    if (good && !(good = urdf_read(&watched.chain, urdf.data, "tool0")))
        fprintf(stderr, "%s has no link tool0\n", key);
    free(urdf.data);
    snprintf(key, sizeof key, "%s/joint_states", wanted->name);
    good = good && zlink_subscribe(link, key, on_joint_state, &watched);
    while (good && watched.frames < frames) good = zlink_wait(link, 1000);
    return good;
}

int main(int argc, char **argv) {
    const char *host = "127.0.0.1", *port = "7447", *name = NULL;
    unsigned batch = 65535, piece = 65536;
    int frames = 10, position = 0;
    for (int i = 1; i < argc; i++) {
        int more = i + 1 < argc;
        if (!strcmp(argv[i], "--host") && more) host = argv[++i];
        else if (!strcmp(argv[i], "--port") && more) port = argv[++i];
        else if (!strcmp(argv[i], "--batch") && more) batch = (unsigned)atoi(argv[++i]);
        else if (!strcmp(argv[i], "--piece") && more) piece = (unsigned)atoi(argv[++i]);
        else if (position++ == 0) name = argv[i];
        else frames = atoi(argv[i]);
    }
    if (batch < 512 || batch > 65535 || piece < 1) {
        fprintf(stderr, "--batch is 512 to 65535 bytes, --piece 1 or more\n");
        return 2;
    }
    zlink *link = zlink_open(host, port, (uint16_t)batch);
    if (!link) return 1;
    static scene found;
    int answers = zlink_get(link, "robots", on_robots, &found, TIMEOUT_MS), good = answers > 0;
    if (!good) fprintf(stderr, "the lab does not say which robots it has\n");
    const robot *wanted = NULL;
    for (int i = 0; i < found.count; i++) {
        const robot *each = &found.robots[i];
        printf("robot %s %s %s\n", each->name, each->model, each->end_effector);
        if (name && !strcmp(each->name, name)) wanted = each;
    }
    fflush(stdout);
    if (good && name && !(good = wanted != NULL))
        fprintf(stderr, "there is no robot %s in the scene\n", name);
    if (good && wanted) good = follow(link, wanted, frames, piece);
    zlink_close(link);
    return good ? 0 : 1;
}
