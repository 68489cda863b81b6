// A program of another DDS implementation, made of the documents in idl/ alone: reads every monitoring topic and prints
// each sample as a line: topic, then the members that tests compare, tabs between.
//   read_topics DOMAIN SECONDS
// Asked to end before, it does when two seconds have brought nothing more.
#include <dds/dds.h>
#include <inttypes.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "calibration.h"
#include "ros2.h"

typedef void (*Print)(const char* topic, const void* sample);

static void print_worker(const char* topic, const void* sample) {
  const demecal_wire_WorkerStatus* s = sample;
  printf("%s\t%s\t%s\t%" PRIu32 "\t%" PRIu32 "\t%d\n", topic, s->worker, s->host, s->process, s->slots,
         (int)s->leaving);
}
static void print_control(const char* topic, const void* sample) {
  const demecal_wire_Control* s = sample;
  printf("%s\t%" PRIu64 "\t%s\t%s\n", topic, s->run, s->state, s->note);
}
static void print_loop(const char* topic, const void* sample) {
  const demecal_wire_LoopNews* s = sample;
  printf("%s\t%" PRIu64 "\t%" PRIu32 "\t%s\t%s\t%s\t%s\t%" PRIu32 "\t%.17g\n", topic, s->calibration, s->round,
         s->stage, s->job, s->text, s->label, s->joint, s->validation_after_m);
}
static void print_cause(const char* topic, const void* sample) {
  const demecal_wire_CauseFound* s = sample;
  printf("%s\t%" PRIu64 "\t%" PRIu32 "\t%s\t%" PRIu32 "\t%s\t%.17g\t%.17g\t%.17g\t%s\n", topic, s->calibration,
         s->number, s->cause, s->joint, s->label, s->without_m, s->with_m, s->share_of_error, s->advice);
}
static void print_final_figures(const char* topic, const void* sample) {
  const demecal_wire_FinalFigures* s = sample;
  printf("%s\t%" PRIu64 "\t%s\t%" PRIu32 "\t%" PRIu32 "\t%.17g\t%.17g\t%.17g\t%.17g\n", topic, s->calibration, s->job,
         s->causes, s->effects, s->validation_before_m, s->validation_after_m, s->accept_before_m, s->accept_after_m);
}
static void print_progress(const char* topic, const void* sample) {
  const demecal_wire_PlacedProgress* p = sample;
  if (p->over) return;
  printf("%s\t%" PRIu64 "\t%" PRIu32 "\t%" PRIu32 "\t%" PRIu32 "\t%" PRIu64 "\t%.17g\t%s\n", topic, p->run, p->joint,
         p->deme, p->generation, p->evaluations, p->best, p->best_formula);
}
static void print_ros2_worker(const char* topic, const void* sample) {
  const demecal_msg_dds__WorkerStatus_* s = sample;
  printf("%s\t%s\t%s\t%" PRIu32 "\t%" PRIu32 "\t%d\n", topic, s->worker, s->host, s->process, s->slots,
         (int)s->leaving);
}
static void print_ros2_control(const char* topic, const void* sample) {
  const demecal_msg_dds__Control_* s = sample;
  printf("%s\t%" PRIu64 "\t%s\t%s\n", topic, s->run, s->state, s->note);
}
static void print_ros2_loop(const char* topic, const void* sample) {
  const demecal_msg_dds__LoopNews_* s = sample;
  printf("%s\t%" PRIu64 "\t%" PRIu32 "\t%s\t%s\t%s\t%s\t%" PRIu32 "\t%.17g\n", topic, s->calibration, s->round,
         s->stage, s->job, s->text, s->label, s->joint, s->validation_after_m);
}
static void print_ros2_cause(const char* topic, const void* sample) {
  const demecal_msg_dds__CauseFound_* s = sample;
  printf("%s\t%" PRIu64 "\t%" PRIu32 "\t%s\t%" PRIu32 "\t%s\t%.17g\t%.17g\t%.17g\t%s\n", topic, s->calibration,
         s->number, s->cause, s->joint, s->label, s->without_m, s->with_m, s->share_of_error, s->advice);
}
static void print_ros2_final_figures(const char* topic, const void* sample) {
  const demecal_msg_dds__FinalFigures_* s = sample;
  printf("%s\t%" PRIu64 "\t%s\t%" PRIu32 "\t%" PRIu32 "\t%.17g\t%.17g\t%.17g\t%.17g\n", topic, s->calibration, s->job,
         s->causes, s->effects, s->validation_before_m, s->validation_after_m, s->accept_before_m, s->accept_after_m);
}
static void print_ros2_progress(const char* topic, const void* sample) {
  const demecal_msg_dds__Progress_* p = sample;
  printf("%s\t%" PRIu64 "\t%" PRIu32 "\t%" PRIu32 "\t%" PRIu32 "\t%" PRIu64 "\t%.17g\t%s\n", topic, p->run, p->joint,
         p->deme, p->generation, p->evaluations, p->best, p->best_formula);
}
static void print_line(const char* topic, const void* sample) {
  const std_msgs_msg_dds__String_* s = sample;
  printf("%s\t%s\n", topic, s->data);
}

struct Watched {
  const char* topic;
  const dds_topic_descriptor_t* type;
  Print print;
  dds_entity_t reader;
};

static struct Watched watched[] = {
    {"demecal/11/worker", &demecal_wire_WorkerStatus_desc, print_worker, 0},
    {"demecal/11/control", &demecal_wire_Control_desc, print_control, 0},
    {"demecal/11/loop", &demecal_wire_LoopNews_desc, print_loop, 0},
    {"demecal/11/cause", &demecal_wire_CauseFound_desc, print_cause, 0},
    {"demecal/11/final_figures", &demecal_wire_FinalFigures_desc, print_final_figures, 0},
    {"demecal/11/progress", &demecal_wire_PlacedProgress_desc, print_progress, 0},
    {"rt/demecal/worker", &demecal_msg_dds__WorkerStatus__desc, print_ros2_worker, 0},
    {"rt/demecal/run_state", &demecal_msg_dds__Control__desc, print_ros2_control, 0},
    {"rt/demecal/loop", &demecal_msg_dds__LoopNews__desc, print_ros2_loop, 0},
    {"rt/demecal/cause", &demecal_msg_dds__CauseFound__desc, print_ros2_cause, 0},
    {"rt/demecal/final_figures", &demecal_msg_dds__FinalFigures__desc, print_ros2_final_figures, 0},
    {"rt/demecal/progress", &demecal_msg_dds__Progress__desc, print_ros2_progress, 0},
    {"rt/demecal/events", &std_msgs_msg_dds__String__desc, print_line, 0},
};
enum { kWatched = sizeof watched / sizeof watched[0], kAtOnce = 64 };

static volatile sig_atomic_t asked_to_end = 0;
static void on_signal(int number) {
  (void)number;
  asked_to_end = 1;
}

/// How many samples came.
static int take_all(const struct Watched* one) {
  void* samples[kAtOnce] = {NULL};
  dds_sample_info_t infos[kAtOnce];
  int count = 0, all = 0;
  while ((count = dds_take(one->reader, samples, infos, kAtOnce, kAtOnce)) > 0) {
    for (int i = 0; i < count; ++i) {
      if (infos[i].valid_data) one->print(one->topic, samples[i]);
    }
    dds_return_loan(one->reader, samples, count);
    all += count;
  }
  return all;
}

int main(int argc, char** argv) {
  if (argc != 3) return 10;
  const dds_entity_t participant = dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL);
  if (participant < 0) return 21;
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
  for (int i = 0; i < kWatched; ++i) {
    const dds_entity_t topic = dds_create_topic(participant, watched[i].type, watched[i].topic, NULL, NULL);
    if (topic < 0) return 21;
    watched[i].reader = dds_create_reader(participant, topic, qos, NULL);
    if (watched[i].reader < 0) return 21;
  }
  puts("reading");
  fflush(stdout);
  signal(SIGTERM, on_signal);
  const dds_time_t end = dds_time() + DDS_SECS(atoi(argv[2]));
  dds_time_t latest = dds_time();
  while (dds_time() < end && !(asked_to_end && dds_time() > latest + DDS_SECS(2))) {
    for (int i = 0; i < kWatched; ++i)
      if (take_all(&watched[i]) > 0) latest = dds_time();
    fflush(stdout);
    dds_sleepfor(DDS_MSECS(50));
  }
  dds_delete(participant);
  return 0;
}
