// Programs that have no IDL learn types from what is announced with a topic, and read the samples.
#include <gtest/gtest.h>

#include <fastrtps/types/DynamicData.h>
#include <fastrtps/types/DynamicDataFactory.h>
#include <fastrtps/types/DynamicDataPtr.h>
#include <fastrtps/types/DynamicPubSubType.h>
#include <condition_variable>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <map>
#include <mutex>

#include "dds/participant.hpp"
#include "network.hpp"
#include "protocol/field_kinds.hpp"
#include "random_messages.hpp"

namespace demecal {
namespace {

namespace types = eprosima::fastrtps::types;
using eprosima::fastdds::dds::DomainParticipantFactory;

/// A DDS program that has nothing of the project but the names of its topics.
class Stranger final : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  Stranger() {
    const DdsOptions options = local_options();
    participant_ = DomainParticipantFactory::get_instance()->create_participant(
        options.domain, participant_qos(options, Role::watcher, "stranger"), this,
        eprosima::fastdds::dds::StatusMask::none());
    subscriber_ = participant_->create_subscriber(eprosima::fastdds::dds::SUBSCRIBER_QOS_DEFAULT);
  }
  ~Stranger() override {
    participant_->delete_contained_entities();
    DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  Stranger(const Stranger&) = delete;
  Stranger& operator=(const Stranger&) = delete;

  void on_type_discovery(eprosima::fastdds::dds::DomainParticipant*, const eprosima::fastrtps::rtps::SampleIdentity&,
                         const eprosima::fastrtps::string_255& topic, const types::TypeIdentifier*,
                         const types::TypeObject*, types::DynamicType_ptr type) override {
    const std::lock_guard lock(mutex_);
    found_[topic.to_string()] = type;
    changed_.notify_all();
  }

  /// The first sample of the topic, by the type that was announced with it.
  types::DynamicData_ptr read(Topic topic) {
    const types::DynamicType_ptr type = type_of(topic_name(topic));
    if (!type) return types::DynamicData_ptr(nullptr);
    const eprosima::fastdds::dds::TypeSupport support(new types::DynamicPubSubType(type));
    support.register_type(participant_);
    auto* const reader =
        subscriber_->create_datareader(participant_->create_topic(topic_name(topic), support.get_type_name(),
                                                                  eprosima::fastdds::dds::TOPIC_QOS_DEFAULT),
                                       reader_qos(topic));
    types::DynamicData_ptr sample(types::DynamicDataFactory::get_instance()->create_data(type));
    eprosima::fastdds::dds::SampleInfo info;
    EXPECT_TRUE(reader->wait_for_unread_message({static_cast<std::int32_t>(kDeadline.count()), 0}));
    EXPECT_EQ(reader->take_next_sample(sample.get(), &info), ReturnCode_t::RETCODE_OK);
    return sample;
  }

 private:
  types::DynamicType_ptr type_of(const std::string& topic) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kDeadline, [&] { return found_.contains(topic); })) << topic;
    return found_[topic];
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, types::DynamicType_ptr> found_;
  eprosima::fastdds::dds::DomainParticipant* participant_ = nullptr;
  eprosima::fastdds::dds::Subscriber* subscriber_ = nullptr;
};

types::MemberId member(const types::DynamicData_ptr& sample, const char* name) {
  return sample->get_member_id_by_name(name);
}

TEST(TypeDiscovery, LetsAProgramWithoutTheDocumentReadWhatIsForPeople) {
  DdsNetwork network;
  const auto coordinator = network.join(Role::coordinator, "coordinator");
  const auto worker = network.join(Role::worker, "worker");
  const auto reporter = network.join(Role::reporter, "reporter");
  RandomMessages random(11);
  const WorkerStatus status = random.status();
  const LoopNews news = random.news();
  CauseFound cause = random.cause();
  FinalFigures figures = random.figures();
  cause.calibration = figures.calibration = news.calibration;
  const Control control = random.control();
  Progress progress = random.progress();
  progress.before.resize(3);
  coordinator->publish(control);
  worker->publish(status);
  worker->publish(progress);
  reporter->publish(news);
  reporter->publish(cause);
  reporter->publish(figures);
  Stranger stranger;

  const auto read_status = stranger.read(Topic::worker);
  ASSERT_TRUE(read_status);
  EXPECT_EQ(read_status->get_string_value(member(read_status, "worker")), status.worker);
  EXPECT_EQ(read_status->get_string_value(member(read_status, "version")), status.version);
  EXPECT_EQ(read_status->get_uint32_value(member(read_status, "slots")), status.slots);
  EXPECT_EQ(read_status->get_bool_value(member(read_status, "leaving")), status.leaving);
  EXPECT_EQ(read_status->get_uint64_value(member(read_status, "only_run")), status.only_run);
  EXPECT_EQ(read_status->get_float64_value(member(read_status, "waited_share")), status.waited_share);

  const auto read_control = stranger.read(Topic::control);
  ASSERT_TRUE(read_control);
  EXPECT_EQ(read_control->get_uint64_value(member(read_control, "run")), control.run);
  EXPECT_EQ(read_control->get_string_value(member(read_control, "state")), "running");
  EXPECT_EQ(read_control->get_string_value(member(read_control, "note")), control.note);

  const auto read_progress = stranger.read(Topic::progress);
  ASSERT_TRUE(read_progress);
  EXPECT_EQ(read_progress->get_string_value(member(read_progress, "worker")), progress.worker);
  EXPECT_EQ(read_progress->get_uint32_value(member(read_progress, "epoch")), progress.epoch);
  EXPECT_EQ(read_progress->get_float64_value(member(read_progress, "best")), progress.figures.best);
  EXPECT_EQ(read_progress->get_string_value(member(read_progress, "best_formula")), progress.best_formula);
  auto* const epochs = read_progress->loan_value(member(read_progress, "before_epoch"));
  auto* const medians = read_progress->loan_value(member(read_progress, "before_median"));
  ASSERT_EQ(epochs->get_item_count(), progress.before.size());
  ASSERT_EQ(medians->get_item_count(), progress.before.size());
  for (std::uint32_t i = 0; i < progress.before.size(); ++i) {
    EXPECT_EQ(epochs->get_uint32_value(i), progress.before[i].epoch);
    EXPECT_EQ(medians->get_float64_value(i), progress.before[i].figures.median);
  }
  read_progress->return_loaned_value(epochs);
  read_progress->return_loaned_value(medians);

  const auto read_news = stranger.read(Topic::loop);
  ASSERT_TRUE(read_news);
  EXPECT_EQ(read_news->get_uint64_value(member(read_news, "calibration")), news.calibration);
  EXPECT_EQ(read_news->get_string_value(member(read_news, "stage")), word_of(news.stage));
  EXPECT_EQ(read_news->get_string_value(member(read_news, "verdict")), word_of(news.verdict));
  EXPECT_EQ(read_news->get_string_value(member(read_news, "label")), news.label);

  const auto read_cause = stranger.read(Topic::cause);
  ASSERT_TRUE(read_cause);
  EXPECT_EQ(read_cause->get_uint64_value(member(read_cause, "calibration")), cause.calibration);
  EXPECT_EQ(read_cause->get_uint32_value(member(read_cause, "number")), cause.number);
  EXPECT_EQ(read_cause->get_string_value(member(read_cause, "advice")), cause.advice);

  const auto read_figures = stranger.read(Topic::final_figures);
  ASSERT_TRUE(read_figures);
  EXPECT_EQ(read_figures->get_string_value(member(read_figures, "job")), figures.job);
  EXPECT_EQ(read_figures->get_float64_value(member(read_figures, "accept_after_m")), figures.accept_after_m);
}

}  // namespace
}  // namespace demecal
