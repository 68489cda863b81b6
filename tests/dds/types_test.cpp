// The types of the topics are to other DDS programs those that fastddsgen makes of idl/calibration.idl.
#include "dds/participant.hpp"

#include <gtest/gtest.h>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>

#include "calibrationPubSubTypes.h"
#include "generated_types.hpp"
#include "network.hpp"
#include "random_messages.hpp"

namespace demecal {
namespace {

using eprosima::fastrtps::rtps::InstanceHandle_t;
using eprosima::fastrtps::rtps::SerializedPayload_t;

/// What one type writes the other reads, to the byte and with the same key.
template <class Generated, class Plain>
void expect_to_be(Topic topic, const Plain& message) {
  using Wire = typename Generated::type;
  Generated generated;
  const eprosima::fastdds::dds::TypeSupport type = topic_type(topic);
  EXPECT_EQ(type.get_type_name(), generated.getName());
  Sample<Plain> ours = message, ours_again;
  Wire theirs = encode<Wire>(message), theirs_again;
  EXPECT_GE(type->getSerializedSizeProvider(&ours)(), to_sample(message).size());
  SerializedPayload_t our_payload(type->getSerializedSizeProvider(&ours)());
  SerializedPayload_t their_payload(generated.getSerializedSizeProvider(&theirs)());
  ASSERT_TRUE(type->serialize(&ours, &our_payload));
  ASSERT_TRUE(generated.serialize(&theirs, &their_payload));
  EXPECT_EQ(our_payload.encapsulation, their_payload.encapsulation);
  EXPECT_TRUE(generated.deserialize(&our_payload, &theirs_again));
  EXPECT_TRUE(type->deserialize(&their_payload, &ours_again));
  EXPECT_EQ(written(theirs_again), written(theirs));
  EXPECT_EQ(ours_again, message);
  for (const bool hashed : {false, true}) {
    InstanceHandle_t our_key, their_key;
    ASSERT_TRUE(type->getKey(&ours, &our_key, hashed));
    ASSERT_TRUE(generated.getKey(&theirs, &their_key, hashed));
    EXPECT_EQ(our_key, their_key);
  }
}

TEST(Types, AreThoseOfTheDocument) {
  RandomMessages random(3);
  for (int i = 0; i < 20; ++i) {
    expect_to_be<wire::MessagePartPubSubType>(Topic::task, MessagePart{random.number(), 1, 2, random.number(), {7, 8}});
    expect_to_be<wire::PlacedProgressPubSubType>(Topic::progress, random.placed_progress());
    expect_to_be<wire::WorkerStatusPubSubType>(Topic::worker, random.status());
    expect_to_be<wire::ControlPubSubType>(Topic::control, random.control());
    expect_to_be<wire::LoopNewsPubSubType>(Topic::loop, random.news());
    expect_to_be<wire::CauseFoundPubSubType>(Topic::cause, random.cause());
    expect_to_be<wire::FinalFiguresPubSubType>(Topic::final_figures, random.figures());
  }
}

TEST(Types, MakeNothingOfBytesThatAreNoSample) {
  for (const Topic topic :
       {Topic::control, Topic::loop, Topic::cause, Topic::final_figures, Topic::worker, Topic::progress, Topic::task}) {
    const eprosima::fastdds::dds::TypeSupport type = topic_type(topic);
    void* sample = type->createData();
    SerializedPayload_t nothing, noise(100);
    noise.length = 100;
    std::fill_n(noise.data, noise.length, std::uint8_t{0xFF});
    for (SerializedPayload_t* payload : {&nothing, &noise}) {
      EXPECT_TRUE(type->deserialize(payload, sample));
      InstanceHandle_t key;
      EXPECT_TRUE(type->getKey(sample, &key, false));
    }
    type->deleteData(sample);
  }
}

namespace fastdds = eprosima::fastdds::dds;

/// A DDS program that has idl/calibration.idl and nothing else of the project.
class Tool {
 public:
  Tool() {
    auto* factory = fastdds::DomainParticipantFactory::get_instance();
    const DdsOptions options = local_options();
    participant_ = factory->create_participant(options.domain, participant_qos(options, Role::watcher, "tool"));
    subscriber_ = participant_->create_subscriber(fastdds::SUBSCRIBER_QOS_DEFAULT);
  }
  ~Tool() {
    participant_->delete_contained_entities();
    fastdds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  Tool(const Tool&) = delete;
  Tool& operator=(const Tool&) = delete;

  /// The first sample of the topic.
  template <class Generated>
  typename Generated::type read(Topic topic) {
    const fastdds::TypeSupport type(new Generated);
    type.register_type(participant_);
    fastdds::DataReader* reader = subscriber_->create_datareader(
        participant_->create_topic(topic_name(topic), type.get_type_name(), fastdds::TOPIC_QOS_DEFAULT),
        reader_qos(topic));
    typename Generated::type sample;
    fastdds::SampleInfo info;
    EXPECT_TRUE(reader->wait_for_unread_message({static_cast<std::int32_t>(kDeadline.count()), 0}));
    EXPECT_EQ(reader->take_next_sample(&sample, &info), ReturnCode_t::RETCODE_OK);
    return sample;
  }

 private:
  fastdds::DomainParticipant* participant_;
  fastdds::Subscriber* subscriber_;
};

TEST(Dds, SamplesAreReadByAnyProgramWithTheDocumentsTypes) {
  DdsNetwork network;
  const auto coordinator = network.join(Role::coordinator, "coordinator");
  const auto worker = network.join(Role::worker, "worker");
  const auto reporter = network.join(Role::reporter, "reporter");
  RandomMessages random(7);
  const WorkerStatus status = random.status();
  const Progress progress = random.progress();
  const Control control = random.control();
  const LoopNews news = random.news();
  CauseFound cause = random.cause();
  FinalFigures figures = random.figures();
  cause.calibration = figures.calibration = news.calibration;
  worker->publish(status);
  worker->publish(progress);
  coordinator->publish(control);
  reporter->publish(news);
  reporter->publish(cause);
  reporter->publish(figures);
  Tool tool;
  EXPECT_EQ(decode<WorkerStatus>(tool.read<wire::WorkerStatusPubSubType>(Topic::worker)), status);
  EXPECT_EQ(decode<PlacedProgress>(tool.read<wire::PlacedProgressPubSubType>(Topic::progress))->progress, progress);
  EXPECT_EQ(decode<Control>(tool.read<wire::ControlPubSubType>(Topic::control)), control);
  EXPECT_EQ(decode<LoopNews>(tool.read<wire::LoopNewsPubSubType>(Topic::loop)), news);
  EXPECT_EQ(decode<CauseFound>(tool.read<wire::CauseFoundPubSubType>(Topic::cause)), cause);
  EXPECT_EQ(decode<FinalFigures>(tool.read<wire::FinalFiguresPubSubType>(Topic::final_figures)), figures);
}

}  // namespace
}  // namespace demecal
